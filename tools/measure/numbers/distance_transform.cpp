#include "tools/measure/numbers/distance_transform.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "formats/parallel.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kRowsAtOnce = 16;
constexpr uint32_t kColumnsAtOnce = 64;

// Distance to the nearest marked pixel of the same column, one sweep down and one up; kNoneMarked in a column without any.
std::vector<uint32_t> distances_in_columns(uint32_t width, uint32_t height, std::span<const uint8_t> marked) {
    std::vector<uint32_t> distances(marked.size());
    auto step = [](uint32_t from) { return from == kNoneMarked ? kNoneMarked : from + 1; };
    parallel_ranges(width, kColumnsAtOnce, [&](size_t begin, size_t end) {
        for (size_t y = 0; y < height; ++y)
            for (size_t x = begin; x < end; ++x) {
                size_t at = y * width + x;
                distances[at] = marked[at] ? 0 : y > 0 ? step(distances[at - width]) : kNoneMarked;
            }
        for (size_t y = height - 1; y-- > 0;)
            for (size_t x = begin; x < end; ++x) {
                size_t at = y * width + x;
                distances[at] = std::min(distances[at], step(distances[at + width]));
            }
    });
    return distances;
}

// A parabola (x - middle)^2 + height, lowest of all from column `from` on.
struct Parabola {
    int64_t middle, height, from;
};

// The first column at which the right one is no higher than the left one.
int64_t takes_over(const Parabola& left, int64_t middle, int64_t height) {
    int64_t above = height + middle * middle - left.height - left.middle * left.middle;
    int64_t twice = 2 * (middle - left.middle);
    return above <= 0 ? 0 : (above + twice - 1) / twice;
}

// Turns one row of distances within columns into squared distances: the lower envelope of a parabola per column.
void square_row(std::span<uint32_t> row, std::vector<Parabola>& envelope) {
    envelope.clear();
    for (size_t x = 0; x < row.size(); ++x) {
        if (row[x] == kNoneMarked) continue;
        int64_t middle = int64_t(x), height = int64_t(row[x]) * row[x];
        int64_t from = 0;
        while (!envelope.empty()) {
            from = takes_over(envelope.back(), middle, height);
            if (from > envelope.back().from) break;
            envelope.pop_back();
            from = 0;
        }
        if (from < int64_t(row.size())) envelope.push_back({middle, height, from});
    }
    for (size_t i = 0; i < envelope.size(); ++i) {
        int64_t end = i + 1 < envelope.size() ? envelope[i + 1].from : int64_t(row.size());
        for (int64_t x = envelope[i].from; x < end; ++x)
            row[size_t(x)] = uint32_t((x - envelope[i].middle) * (x - envelope[i].middle) + envelope[i].height);
    }
}

}  // namespace

std::vector<uint32_t> squared_distances_px(uint32_t width, uint32_t height, std::span<const uint8_t> marked) {
    assert(width >= 1 && width <= 32768 && height >= 1 && height <= 32768 && marked.size() == size_t(width) * height);
    std::vector<uint32_t> distances = distances_in_columns(width, height, marked);
    parallel_ranges(height, kRowsAtOnce, [&](size_t begin, size_t end) {
        std::vector<Parabola> envelope;
        for (size_t y = begin; y < end; ++y) square_row(std::span(distances).subspan(y * width, width), envelope);
    });
    return distances;
}

}  // namespace overlook::measure
