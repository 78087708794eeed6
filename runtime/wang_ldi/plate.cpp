#include "runtime/wang_ldi/plate.h"

#include <algorithm>
#include <cassert>

#include "formats/srgb.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kGap_px = 8;
constexpr uint8_t kLine = 110;

}  // namespace

Plate::Plate(uint32_t cells, uint32_t columns, uint32_t width_px, uint32_t height_px)
    : columns_(std::min(cells, columns)), width_px_(width_px), height_px_(height_px) {
    uint32_t rows = (cells + columns_ - 1) / columns_;
    picture_.width = kGap_px + columns_ * (width_px + kGap_px), picture_.height = kGap_px + rows * (height_px + kGap_px);
    picture_.pixels.assign(size_t(picture_.width) * picture_.height * 3, 255);
}

uint8_t* Plate::pixel(uint32_t cell, uint32_t x, uint32_t y) {
    size_t left = kGap_px + size_t(cell % columns_) * (width_px_ + kGap_px),
           top = kGap_px + size_t(cell / columns_) * (height_px_ + kGap_px);
    return picture_.pixels.data() + ((top + y) * picture_.width + left + x) * 3;
}

void Plate::put(uint32_t cell, const Warped& drawn) {
    assert(drawn.width_px == 2 * width_px_ && drawn.height_px == 2 * height_px_);
    const std::array<double, 256>& linear = linear_of_srgb_codes();
    for (uint32_t y = 0; y < height_px_; ++y)
        for (uint32_t x = 0; x < width_px_; ++x) {
            std::array<double, 3> sum{};
            for (uint32_t quarter = 0; quarter < 4; ++quarter) {
                size_t at = size_t(2 * y + quarter / 2) * drawn.width_px + 2 * x + quarter % 2;
                uint32_t colour = drawn.colours[at] == 0 ? 0xffffff : drawn.colours[at];
                for (size_t c = 0; c < 3; ++c) sum[c] += linear[colour >> (8 * c) & 0xff] / 4;
            }
            for (size_t c = 0; c < 3; ++c) pixel(cell, x, y)[c] = uint8_t(255 * srgb_from_linear(sum[c]) + 0.5);
        }
}

void Plate::frame(uint32_t cell, uint32_t low_px, uint32_t high_px) {
    for (uint32_t at = low_px; at < high_px; ++at)
        for (uint8_t* line :
             {pixel(cell, at, low_px), pixel(cell, at, high_px - 1), pixel(cell, low_px, at), pixel(cell, high_px - 1, at)})
            std::fill_n(line, 3, kLine);
}

}  // namespace overlook::wang_ldi
