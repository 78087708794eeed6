#include "formats/terrain_ranges.h"

#include <algorithm>

#include "formats/parallel.h"

namespace overlook::terrain {
namespace {

constexpr size_t kRowsAtATime = 16;

StepRange join(StepRange a, StepRange b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

StepRange step_range(int32_t height) {
    return {height, height};
}

using Ranges = SquareRanges::Level;

// Of the samples of each closed square of two cells.
Ranges finest_ranges(const Terrain& terrain) {
    uint32_t width = terrain.shape.width, height = terrain.shape.height;
    Ranges ranges{width / 2, height / 2, {}};
    ranges.ranges.assign(size_t(ranges.columns) * ranges.rows, StepRange{});
    parallel_ranges(ranges.rows, kRowsAtATime, [&](size_t first, size_t end) {
        for (size_t j = first; j < end; ++j)
            for (uint32_t i = 0; i < ranges.columns; ++i) {
                StepRange& range = ranges.ranges[j * ranges.columns + i];
                for (uint32_t y = uint32_t(2 * j); y <= std::min<uint32_t>(uint32_t(2 * j + 2), height - 1); ++y)
                    for (uint32_t x = 2 * i; x <= std::min(2 * i + 2, width - 1); ++x)
                        if (!terrain.is_void(x, y)) range = join(range, step_range(terrain.heights[size_t(y) * width + x]));
            }
    });
    return ranges;
}

Ranges halved(const Ranges& finer) {
    Ranges ranges{(finer.columns + 1) / 2, (finer.rows + 1) / 2, {}};
    ranges.ranges.assign(size_t(ranges.columns) * ranges.rows, StepRange{});
    for (uint32_t j = 0; j < finer.rows; ++j)
        for (uint32_t i = 0; i < finer.columns; ++i) {
            StepRange& range = ranges.ranges[size_t(j / 2) * ranges.columns + i / 2];
            range = join(range, finer.ranges[size_t(j) * finer.columns + i]);
        }
    return ranges;
}

// Each square with its eight neighbours: first along rows, then along columns.
Ranges dilated(const Ranges& in) {
    Ranges along = in, out = in;
    for (uint32_t j = 0; j < in.rows; ++j)
        for (uint32_t i = 0; i < in.columns; ++i)
            for (uint32_t k = i > 0 ? i - 1 : 0; k <= std::min(i + 1, in.columns - 1); ++k)
                along.ranges[size_t(j) * in.columns + i] =
                    join(along.ranges[size_t(j) * in.columns + i], in.ranges[size_t(j) * in.columns + k]);
    for (uint32_t j = 0; j < in.rows; ++j)
        for (uint32_t i = 0; i < in.columns; ++i)
            for (uint32_t k = j > 0 ? j - 1 : 0; k <= std::min(j + 1, in.rows - 1); ++k)
                out.ranges[size_t(j) * in.columns + i] =
                    join(out.ranges[size_t(j) * in.columns + i], along.ranges[size_t(k) * in.columns + i]);
    return out;
}

}  // namespace

SquareRanges::SquareRanges(const Terrain& terrain) {
    Ranges ranges = finest_ranges(terrain);
    for (StepRange range : ranges.ranges) whole_ = join(whole_, range);
    for (uint32_t level = 0; level < terrain.shape.root_log2; ++level) {
        if (level > 0) ranges = halved(ranges);
        levels_.push_back(dilated(ranges));
    }
}

}  // namespace overlook::terrain
