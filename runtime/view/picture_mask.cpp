#include "runtime/view/picture_mask.h"

#include <algorithm>
#include <cassert>

namespace overlook::view {
namespace {

// The cell that a share lies in, as far as there are any.
uint32_t cell_of(double share, uint32_t cells) {
    return uint32_t(std::clamp(share * cells, 0.0, cells - 1.0));
}

}  // namespace

PictureMask::PictureMask(uint32_t columns, uint32_t rows, std::span<const uint8_t> is_marked)
    : columns_(columns), rows_(rows), sums_(size_t(columns + 1) * (rows + 1)) {
    assert(columns >= 1 && rows >= 1 && is_marked.size() == size_t(columns) * rows);
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0, in_row = 0; x < columns; ++x) {
            in_row += is_marked[size_t(y) * columns + x] != 0;
            sums_[size_t(y + 1) * (columns + 1) + x + 1] = sums_[size_t(y) * (columns + 1) + x + 1] + in_row;
        }
}

bool PictureMask::is_touched(double left, double right, double top, double bottom) const {
    if (is_empty() || !(right >= 0) || !(left <= 1) || !(bottom >= 0) || !(top <= 1)) return false;
    size_t x0 = cell_of(left, columns_), x1 = cell_of(right, columns_) + 1;
    size_t y0 = cell_of(top, rows_), y1 = cell_of(bottom, rows_) + 1, stride = columns_ + 1;
    return sums_[y1 * stride + x1] + sums_[y0 * stride + x0] > sums_[y1 * stride + x0] + sums_[y0 * stride + x1];
}

}  // namespace overlook::view
