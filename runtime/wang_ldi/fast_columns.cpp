#include "runtime/wang_ldi/fast_columns.h"

#include <algorithm>

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kAtOnce = 1024;  // samples between bringing and painting, few enough to stay near the processor

template <Hiding hiding>
inline void put(int64_t& pixel, int64_t key) {
    pixel = hiding == Hiding::by_order ? key : std::min(pixel, key);
}
template <Hiding hiding>
inline void put_square(int64_t* pixel, ptrdiff_t stride, int side, int64_t key) {
    for (int y = 0; y < side; ++y, pixel += stride)
        for (int x = 0; x < side; ++x) put<hiding>(pixel[x], key);
}

void copy(const glm::vec3& from, float (&to)[3]) {
    for (int k = 0; k < 3; ++k) to[k] = from[k];
}

}  // namespace

template <Hiding hiding>
FastColumns<hiding>::FastColumns(const Eye& eye, const ImageSet& set, const PreparedLdi& ldi, uint32_t level,
                                 const SplatRule& rule, const glm::dvec2& south_west_m, FastTools& tools)
    : eye_(eye), ldi_(ldi), tools_(tools), frame_(eye, set, set.levels[level], !ldi.splats.empty(), rule, south_west_m) {
    side_px = ldi.side_px;
    eye_column_ = cell_at((eye.position_m.x - south_west_m.x) / set.tile_m, side_px);
    const Canvas& canvas = *tools.canvas;
    row_ = {};
    copy(frame_.up, row_.up);
    row_.pixel_m = frame_.pixel_m, row_.step_m = frame_.step_m, row_.near_m = eye.near_m;
    row_.middle_px[0] = eye.middle_px.x, row_.middle_px[1] = eye.middle_px.y;
    row_.width_px = int32_t(canvas.width_px()), row_.height_px = int32_t(canvas.height_px());
    row_.most_side = eye.most_splat_px;
    row_.stride = canvas.stride(), row_.origin = canvas.origin(), row_.nowhere = 0;
}

template <Hiding hiding>
void FastColumns<hiding>::stand_on(const Plane& plane) {
    frame_.stand_on(eye_, plane);
    copy(frame_.east, row_.east);
    row_.splat = frame_.splat;
}

template <Hiding hiding>
bool FastColumns<hiding>::may_show(uint32_t row, const Span& columns) const {
    const uint32_t* first = first_of_row(row);
    if (first[columns.from] == first[columns.to]) return false;
    return is_inside || may_be_seen(row, columns, frame_.corner + frame_.middle_m(row) * frame_.north);
}

template <Hiding hiding>
void FastColumns<hiding>::draw_row(uint32_t row, const Span& columns, const uint32_t* shown) {
    size_t pixel = size_t(row) * side_px;
    uint32_t begin = ldi_.first[pixel + columns.from], end = ldi_.first[pixel + columns.to];
    if (begin == end) return;
    glm::vec3 foot = frame_.corner + frame_.middle_m(row) * frame_.north;
    if (!is_inside && !may_be_seen(row, columns, foot)) return;
    copy(foot, row_.foot);
    uint32_t most = hiding == Hiding::by_depth ? std::min(kAtOnce, end - begin) : end - begin;
    if (tools_.pixels.size() < most + PreparedLdi::kPadding) {
        size_t size = most + PreparedLdi::kPadding;
        tools_.pixels.resize(size), tools_.sides.resize(size), tools_.depths_m.resize(size);
    }
    Projected projected{tools_.pixels.data(), tools_.sides.data(), tools_.depths_m.data()};
    for (; begin < end; begin += most) {
        uint32_t count = std::min(most, end - begin);
        ProjectedCounts counts;
        const uint8_t* splats = ldi_.splats.empty() ? nullptr : ldi_.splats.data() + begin;
        tools_.project(row_, ldi_.places.data() + begin, splats, shown, count, projected, counts);
        tools_.counts.samples += counts.samples, tools_.counts.samples_drawn += counts.drawn;
        tools_.counts.pixels_written += counts.pixels;
        if (counts.drawn == 0) continue;
        if (hiding == Hiding::by_order)
            paint_towards(row, columns);
        else
            paint(begin, begin + count, counts);
    }
}

// A row's samples lie in a rectangle that stands up: not if its corners are all behind one of the picture's sides.
template <Hiding hiding>
bool FastColumns<hiding>::may_be_seen(uint32_t row, const Span& columns, const glm::vec3& foot) const {
    float wide = frame_.splat * (ldi_.splats.empty() ? 1.0f : 255.0f);
    glm::vec2 half_px = eye_.middle_px + 2.0f;
    bool is_left = true, is_right = true, is_above = true, is_below = true, is_near = true;
    for (uint32_t corner = 0; corner < 4; ++corner) {
        float x = frame_.middle_m(corner & 1 ? columns.to : columns.from) - 0.5f * frame_.pixel_m;
        float z = float(corner & 2 ? ldi_.highest[row] : ldi_.lowest[row]) * frame_.step_m;
        glm::vec3 seen = (foot + x * frame_.east) + z * frame_.up;
        glm::vec2 side = half_px * seen.z + wide / 2;
        is_left &= seen.x<-side.x, is_right &= seen.x> side.x;
        is_below &= seen.y<-side.y, is_above &= seen.y> side.y;
        is_near &= seen.z < 0.99f * eye_.near_m;
    }
    return !(is_left || is_right || is_above || is_below || is_near);
}

template <Hiding hiding>
void FastColumns<hiding>::paint(uint32_t begin, uint32_t end, const ProjectedCounts& counts) {
    if (counts.least_side != counts.most_side || counts.most_side > 4) return paint_uneven(begin, end);
    switch (counts.most_side) {
        case 1:
            return paint_even<1>(begin, end);
        case 2:
            return paint_even<2>(begin, end);
        case 3:
            return paint_even<3>(begin, end);
        default:
            return paint_even<4>(begin, end);
    }
}

// Splats of one size; those that are not drawn are painted where nothing is seen.
template <Hiding hiding>
template <int side>
void FastColumns<hiding>::paint_even(uint32_t begin, uint32_t end) {
    int64_t* keys = tools_.canvas->keys();
    ptrdiff_t stride = row_.stride;
    const uint32_t* palette = ldi_.palette.data();
    const uint8_t* colours = ldi_.colours.data() + begin;
    for (uint32_t k = 0; k < end - begin; ++k) {
        int64_t key = pixel_key(tools_.depths_m[k], palette[colours[k]]);
        put_square<hiding>(keys + tools_.pixels[k], stride, side, key);
    }
}

template <Hiding hiding>
void FastColumns<hiding>::paint_uneven(uint32_t begin, uint32_t end) {
    for (uint32_t k = 0; k < end - begin; ++k) paint_one(k, begin + k);
}

template <Hiding hiding>
inline void FastColumns<hiding>::paint_one(uint32_t projected, uint32_t sample) {
    int64_t key = pixel_key(tools_.depths_m[projected], ldi_.palette[ldi_.colours[sample]]);
    int64_t* pixel = tools_.canvas->keys() + tools_.pixels[projected];
    ptrdiff_t stride = row_.stride;
    switch (int side = tools_.sides[projected]; side) {
        case 1:
            return put_square<hiding>(pixel, stride, 1, key);
        case 2:
            return put_square<hiding>(pixel, stride, 2, key);
        case 3:
            return put_square<hiding>(pixel, stride, 3, key);
        default:
            return put_square<hiding>(pixel, stride, side, key);
    }
}

// All columns of a row that were brought to the picture, towards the eye.
template <Hiding hiding>
void FastColumns<hiding>::paint_towards(uint32_t row, const Span& columns) {
    uint32_t begin = ldi_.first[size_t(row) * side_px + columns.from];
    for (uint32_t i = 0; i < columns.to - columns.from; ++i) paint_column(towards(i, eye_column_, columns), row, begin);
}

template <Hiding hiding>
inline void FastColumns<hiding>::paint_column(uint32_t column, uint32_t row, uint32_t begin) {
    size_t pixel = size_t(row) * side_px + column;
    uint32_t first = ldi_.first[pixel], end = ldi_.first[pixel + 1];
    if (first == end) return;
    double eye_steps = frame_.eye_steps(column, row);
    uint32_t below = end;
    while (below > first && !(double(ldi_.places[below - 1] >> 16) < eye_steps)) --below;
    for (uint32_t s = first; s < below; ++s) paint_one(s - begin, s);
    for (uint32_t s = end; s > below; --s) paint_one(s - 1 - begin, s - 1);
}

template class FastColumns<Hiding::by_order>;
template class FastColumns<Hiding::by_depth>;

}  // namespace overlook::wang_ldi
