// Parts of a camera's picture, marked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace overlook::view {

// An even grid of cells over a picture, some of them marked. Of sums over its rectangles, so that asking costs the same for any.
class PictureMask {
  public:
    PictureMask() = default;  // nothing is marked
    // is_marked: [rows, columns], top row first; both at least 1.
    PictureMask(uint32_t columns, uint32_t rows, std::span<const uint8_t> is_marked);

    bool is_empty() const { return sums_.empty() || sums_.back() == 0; }
    uint32_t marked_count() const { return sums_.empty() ? 0 : sums_.back(); }
    // Does a rectangle that includes its sides touch a marked cell? In shares of the picture's width and height from its top
    // left; it may reach beyond the picture, left <= right and top <= bottom.
    bool is_touched(double left, double right, double top, double bottom) const;

  private:
    uint32_t columns_ = 0, rows_ = 0;
    std::vector<uint32_t> sums_;  // [rows + 1, columns + 1], of what is above and left
};

}  // namespace overlook::view
