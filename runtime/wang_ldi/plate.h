// Small pictures of warped tiles in rows, on one large one.
#pragma once

#include <array>
#include <cstdint>

#include "formats/image.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

class Plate {
  public:
    // cells: how many pictures, 1 or more, in rows of `columns`, 1 or more; white where none is put.
    Plate(uint32_t cells, uint32_t columns, uint32_t width_px, uint32_t height_px);

    // From the top left on, row by row. `drawn`: twice as wide and as high as a cell; four of its pixels become one, their mean
    // in linear light, white where nothing is.
    void put(uint32_t cell, const Warped& drawn);
    // A grey line, one pixel wide, round [low, high)^2 of a cell.
    void frame(uint32_t cell, uint32_t low_px, uint32_t high_px);

    const ImageRgb8& picture() const { return picture_; }

  private:
    uint8_t* pixel(uint32_t cell, uint32_t x, uint32_t y);

    uint32_t columns_, width_px_, height_px_;
    ImageRgb8 picture_;
};

}  // namespace overlook::wang_ldi
