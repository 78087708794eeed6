#include "runtime/wang_ldi/hole_fill.h"

#include <algorithm>
#include <vector>

#include "formats/parallel.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kRowsAtOnce = 32;

struct Filling {
    uint32_t pixel = 0, from = 0;  // indices into the picture
};

// How far the first pixel of something is from p along a step, among `room` pixels that way; 0: none within reach.
uint32_t reach(const Warped& picture, size_t p, ptrdiff_t step, uint32_t room, uint32_t widest) {
    for (uint32_t n = 1; n <= std::min(room, widest); ++n)
        if (picture.colours[size_t(ptrdiff_t(p) + ptrdiff_t(n) * step)] != 0) return n;
    return 0;
}

// What closes a pixel's gap along a step and against it, the farther of the two; p itself if it is not closed.
size_t closing(const Warped& picture, size_t p, ptrdiff_t step, uint32_t room_back, uint32_t room_on, uint32_t widest) {
    uint32_t back = reach(picture, p, -step, room_back, widest), on = reach(picture, p, step, room_on, widest);
    if (back == 0 || on == 0 || back + on - 1 > widest) return p;
    size_t one = p - size_t(back) * size_t(step), other = p + size_t(on) * size_t(step);
    return picture.depth_m[other] > picture.depth_m[one] ? other : one;
}

bool is_farther(const Warped& picture, size_t a, size_t b) {
    if (picture.depth_m[a] != picture.depth_m[b]) return picture.depth_m[a] > picture.depth_m[b];
    return picture.colours[a] < picture.colours[b];
}

void find_in_row(const Warped& picture, uint32_t y, uint32_t widest, std::vector<Filling>& found) {
    uint32_t width = picture.width_px, height = picture.height_px;
    size_t begin = size_t(y) * width;
    for (uint32_t x = 1, empty = 0; x + 1 < width; ++x) {
        if (picture.colours[begin + x] != 0) {
            empty = 0;
            continue;
        }
        if (++empty > widest) continue;  // the first of a wide gap are looked at, and found to be open
        size_t p = begin + x, beside = closing(picture, p, 1, x, width - 1 - x, widest);
        if (beside == p) continue;
        size_t above = closing(picture, p, width, y, height - 1 - y, widest);
        if (above == p) continue;
        found.push_back({uint32_t(p), uint32_t(is_farther(picture, beside, above) ? beside : above)});
    }
}

}  // namespace

uint64_t fill_holes(Warped& picture, uint32_t finer) {
    std::vector<std::vector<Filling>> found((picture.height_px + kRowsAtOnce - 1) / kRowsAtOnce);
    parallel_ranges(picture.height_px, kRowsAtOnce, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y)
            find_in_row(picture, uint32_t(y), finer * kWidestHole_px, found[begin / kRowsAtOnce]);
    });
    uint64_t filled = 0;
    for (const auto& band : found)
        for (const Filling& one : band) {
            picture.colours[one.pixel] = picture.colours[one.from], picture.depth_m[one.pixel] = picture.depth_m[one.from];
            ++filled;
        }
    return filled;
}

}  // namespace overlook::wang_ldi
