// Lowest and highest height round every split vertex of a terrain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "formats/terrain.h"

namespace overlook::terrain {

struct StepRange {
    int32_t low = std::numeric_limits<int32_t>::max(), high = std::numeric_limits<int32_t>::min();  // in steps
    bool is_empty() const { return low > high; }                                                    // no valid sample
};

// One grid a level; the range of the 3 x 3 squares of side 2^(level+1) round a square is that of all samples within 3 * 2^level
// of its middle, borders included: it contains everything that splitting in that square can bring up, at any depth. So ranges are
// nested.
class SquareRanges {
  public:
    // Cost O(samples); keeps 2.7 bytes a sample.
    explicit SquareRanges(const Terrain& terrain);

    struct Level {
        uint32_t columns = 0, rows = 0;
        std::vector<StepRange> ranges;  // [rows, columns]
    };
    const std::vector<Level>& levels() const { return levels_; }
    StepRange whole() const { return whole_; }

    // Of the square of side 2^(level+1) that holds virtual vertex (x, y) in its middle; beyond the last square, of that.
    StepRange of_square(uint32_t x, uint32_t y, uint32_t level) const {
        const Level& grid = levels_[level];
        uint32_t i = std::min(x >> (level + 1), grid.columns - 1), j = std::min(y >> (level + 1), grid.rows - 1);
        return grid.ranges[size_t(j) * grid.columns + i];
    }

  private:
    std::vector<Level> levels_;
    StepRange whole_;
};

}  // namespace overlook::terrain
