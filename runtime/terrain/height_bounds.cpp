#include "runtime/terrain/height_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/parallel.h"

namespace overlook::terrain {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr HeightRange kEmpty{kInfinite, -kInfinite};
constexpr size_t kRowsAtATime = 16;

HeightRange join(HeightRange a, HeightRange b) {
    return {std::min(a.low_m, b.low_m), std::max(a.high_m, b.high_m)};
}

// The float range of a height, rounded outward.
HeightRange range_of(double height_m) {
    float nearest = float(height_m);
    if (double(nearest) == height_m) return {nearest, nearest};
    return {std::nextafter(nearest, -kInfinite), std::nextafter(nearest, kInfinite)};
}

struct Ranges {
    uint32_t columns, rows;
    std::vector<HeightRange> values;
};

// Of the samples of each closed square of two cells.
Ranges finest_ranges(const Terrain& terrain) {
    uint32_t width = terrain.shape.width, height = terrain.shape.height;
    Ranges ranges{width / 2, height / 2, {}};
    ranges.values.assign(size_t(ranges.columns) * ranges.rows, kEmpty);
    parallel_ranges(ranges.rows, kRowsAtATime, [&](size_t first, size_t end) {
        for (size_t j = first; j < end; ++j)
            for (uint32_t i = 0; i < ranges.columns; ++i) {
                HeightRange& range = ranges.values[j * ranges.columns + i];
                for (uint32_t y = uint32_t(2 * j); y <= std::min<uint32_t>(uint32_t(2 * j + 2), height - 1); ++y)
                    for (uint32_t x = 2 * i; x <= std::min(2 * i + 2, width - 1); ++x)
                        if (!terrain.is_void(x, y)) range = join(range, range_of(terrain.height_m(x, y)));
            }
    });
    return ranges;
}

Ranges halved(const Ranges& finer) {
    Ranges ranges{(finer.columns + 1) / 2, (finer.rows + 1) / 2, {}};
    ranges.values.assign(size_t(ranges.columns) * ranges.rows, kEmpty);
    for (uint32_t j = 0; j < finer.rows; ++j)
        for (uint32_t i = 0; i < finer.columns; ++i) {
            HeightRange& range = ranges.values[size_t(j / 2) * ranges.columns + i / 2];
            range = join(range, finer.values[size_t(j) * finer.columns + i]);
        }
    return ranges;
}

// Each square with its eight neighbours: first along rows, then along columns.
Ranges dilated(const Ranges& in) {
    Ranges along = in, out = in;
    for (uint32_t j = 0; j < in.rows; ++j)
        for (uint32_t i = 0; i < in.columns; ++i)
            for (uint32_t k = i > 0 ? i - 1 : 0; k <= std::min(i + 1, in.columns - 1); ++k)
                along.values[size_t(j) * in.columns + i] =
                    join(along.values[size_t(j) * in.columns + i], in.values[size_t(j) * in.columns + k]);
    for (uint32_t j = 0; j < in.rows; ++j)
        for (uint32_t i = 0; i < in.columns; ++i)
            for (uint32_t k = j > 0 ? j - 1 : 0; k <= std::min(j + 1, in.rows - 1); ++k)
                out.values[size_t(j) * in.columns + i] =
                    join(out.values[size_t(j) * in.columns + i], along.values[size_t(k) * in.columns + i]);
    return out;
}

}  // namespace

HeightBounds::HeightBounds(const Terrain& terrain) {
    Ranges ranges = finest_ranges(terrain);
    whole_ = kEmpty;
    for (HeightRange range : ranges.values) whole_ = join(whole_, range);
    for (uint32_t level = 0; level < terrain.shape.root_log2; ++level) {
        if (level > 0) ranges = halved(ranges);
        Ranges wide = dilated(ranges);
        levels_.push_back({wide.columns, wide.rows, std::move(wide.values)});
    }
}

}  // namespace overlook::terrain
