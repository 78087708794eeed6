#include "tools/measure/numbers/gaps.h"

#include <algorithm>

namespace overlook::measure {
namespace {

// Covered, and all that touch it.
bool is_inside(const std::vector<uint8_t>& truth, uint32_t width, uint32_t height, uint32_t x, uint32_t y) {
    for (uint32_t j = y == 0 ? 0 : y - 1; j <= std::min(y + 1, height - 1); ++j)
        for (uint32_t i = x == 0 ? 0 : x - 1; i <= std::min(x + 1, width - 1); ++i)
            if (truth[size_t(j) * width + i] == 0) return false;
    return true;
}

// Side of the largest square of pixels that are set: of each, the largest of which it is the last corner.
uint32_t widest_square(const std::vector<uint8_t>& mask, uint32_t width) {
    std::vector<uint32_t> above(width + 1), row(width + 1);
    uint32_t widest = 0;
    for (size_t begin = 0; begin < mask.size(); begin += width) {
        for (uint32_t x = 0; x < width; ++x) {
            row[x + 1] = mask[begin + x] ? 1 + std::min({above[x], above[x + 1], row[x]}) : 0;
            widest = std::max(widest, row[x + 1]);
        }
        std::swap(above, row);
    }
    return widest;
}

uint32_t largest_piece(std::vector<uint8_t> mask, uint32_t width) {
    uint32_t largest = 0;
    std::vector<size_t> open;
    auto take = [&](size_t p) {
        if (mask[p]) mask[p] = 0, open.push_back(p);
    };
    for (size_t start = 0; start < mask.size(); ++start) {
        uint32_t count = 0;
        for (take(start); !open.empty(); ++count) {
            size_t p = open.back();
            open.pop_back();
            if (p % width > 0) take(p - 1);
            if (p % width + 1 < width) take(p + 1);
            if (p >= width) take(p - width);
            if (p + width < mask.size()) take(p + width);
        }
        largest = std::max(largest, count);
    }
    return largest;
}

}  // namespace

void Gaps::add(const Gaps& other) {
    covered_px += other.covered_px, gap_px += other.gap_px;
    widest_px = std::max(widest_px, other.widest_px), largest_px = std::max(largest_px, other.largest_px);
}

Gaps gaps_of(const std::vector<uint8_t>& truth, const std::vector<uint8_t>& test, uint32_t width_px,
             const std::vector<uint8_t>& asked) {
    auto height_px = uint32_t(truth.size() / width_px);
    std::vector<uint8_t> mask(truth.size());
    Gaps gaps;
    for (uint32_t y = 0; y < height_px; ++y)
        for (uint32_t x = 0; x < width_px; ++x) {
            size_t p = size_t(y) * width_px + x;
            if ((!asked.empty() && asked[p] == 0) || !is_inside(truth, width_px, height_px, x, y)) continue;
            ++gaps.covered_px;
            mask[p] = test[p] == 0, gaps.gap_px += mask[p];
        }
    gaps.widest_px = widest_square(mask, width_px), gaps.largest_px = largest_piece(std::move(mask), width_px);
    return gaps;
}

}  // namespace overlook::measure
