// What any rectangle of a raster's cells has in common, without looking at each cell: values of blocks of cells, of blocks of
// such blocks, and so on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace overlook::wang_ldi {

// Value: a default one holds nothing; take(other) makes it hold what the other holds too.
template <class Value>
class Pyramid {
  public:
    static constexpr uint32_t kLeaf_log2 = 3;  // the finest blocks have 8 x 8 cells

    Pyramid() = default;
    // at(column, row): of each cell. Memory: a value for 48 cells. O(columns * rows).
    template <class At>
    Pyramid(uint32_t columns, uint32_t rows, const At& at) {
        levels_.push_back(Level(((columns - 1) >> kLeaf_log2) + 1, ((rows - 1) >> kLeaf_log2) + 1));
        for (uint32_t row = 0; row < rows; ++row)
            for (uint32_t column = 0; column < columns; ++column)
                levels_[0].at(column >> kLeaf_log2, row >> kLeaf_log2).take(at(column, row));
        while (levels_.back().columns > 1 || levels_.back().rows > 1) {
            const Level& below = levels_.back();
            Level above((below.columns + 1) / 2, (below.rows + 1) / 2);
            for (uint32_t j = 0; j < below.rows; ++j)
                for (uint32_t i = 0; i < below.columns; ++i) above.at(i / 2, j / 2).take(below.at(i, j));
            levels_.push_back(std::move(above));
        }
    }

    // Holds what all cells from (left, top) to (right, bottom), both inclusive, hold, and perhaps some round them. O(1).
    Value bound(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom) const {
        uint32_t level = 0, shift = kLeaf_log2;
        while (level + 1 < levels_.size() && ((right >> shift) - (left >> shift) > 2 || (bottom >> shift) - (top >> shift) > 2))
            ++level, ++shift;
        Value all;
        for (uint32_t j = top >> shift; j <= bottom >> shift; ++j)
            for (uint32_t i = left >> shift; i <= right >> shift; ++i) all.take(levels_[level].at(i, j));
        return all;
    }

  private:
    struct Level {
        uint32_t columns, rows;
        std::vector<Value> values;

        Level(uint32_t columns_, uint32_t rows_) : columns(columns_), rows(rows_), values(size_t(columns_) * rows_) {}
        Value& at(uint32_t i, uint32_t j) { return values[size_t(j) * columns + i]; }
        const Value& at(uint32_t i, uint32_t j) const { return values[size_t(j) * columns + i]; }
    };
    std::vector<Level> levels_;
};

}  // namespace overlook::wang_ldi
