#include "runtime/terrain/height_bounds.h"

#include <cmath>

#include "formats/parallel.h"
#include "formats/terrain_ranges.h"

namespace overlook::terrain {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr size_t kRangesAtATime = 65536;

}  // namespace

HeightRange height_range_of(const Terrain& terrain, StepRange range) {
    if (range.is_empty()) return {kInfinite, -kInfinite};
    double low_m = terrain.height_offset_m + terrain.height_step_m * range.low,
           high_m = terrain.height_offset_m + terrain.height_step_m * range.high;
    float low = float(low_m), high = float(high_m);
    return {double(low) <= low_m ? low : std::nextafter(low, -kInfinite),
            double(high) >= high_m ? high : std::nextafter(high, kInfinite)};
}

HeightBounds::HeightBounds(const Terrain& terrain) {
    SquareRanges ranges(terrain);
    whole_ = height_range_of(terrain, ranges.whole());
    for (const SquareRanges::Level& from : ranges.levels()) {
        Level& level = levels_.emplace_back(Level{from.columns, from.rows, {}});
        level.ranges.resize(from.ranges.size());
        parallel_ranges(level.ranges.size(), kRangesAtATime, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) level.ranges[i] = height_range_of(terrain, from.ranges[i]);
        });
    }
}

}  // namespace overlook::terrain
