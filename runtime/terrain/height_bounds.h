// Lowest and highest height round every split vertex: nested, so that a test that uses them is monotone.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/terrain.h"
#include "formats/terrain_ranges.h"

namespace overlook::terrain {

struct HeightRange {
    float low_m, high_m;  // low > high: no valid sample
    bool is_empty() const { return low_m > high_m; }
};

// The least range of floats, in metres, that holds it: nested ranges stay nested.
HeightRange height_range_of(const Terrain& terrain, StepRange range);

// One grid a level; the range of the 3 x 3 squares of side 2^(level+1) round a square is that of all samples within 3 * 2^level
// of its middle, borders included: it contains everything that splitting in that square can bring up, at any depth.
class HeightBounds {
  public:
    explicit HeightBounds(const Terrain& terrain);

    // Of the square of side 2^(level+1) that holds virtual vertex (x, y) in its middle.
    HeightRange of_square(uint32_t x, uint32_t y, uint32_t level) const {
        const Level& grid = levels_[level];
        uint32_t i = x >> (level + 1), j = y >> (level + 1);
        i = i < grid.columns ? i : grid.columns - 1;
        j = j < grid.rows ? j : grid.rows - 1;
        return grid.ranges[size_t(j) * grid.columns + i];
    }
    HeightRange whole() const { return whole_; }

  private:
    struct Level {
        uint32_t columns = 0, rows = 0;
        std::vector<HeightRange> ranges;
    };
    std::vector<Level> levels_;
    HeightRange whole_{};
};

}  // namespace overlook::terrain
