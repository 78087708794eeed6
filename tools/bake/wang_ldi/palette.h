// A few colours that stand for many.
//
// Based on: P. Heckbert, Color Image Quantization for Frame Buffer Display, 1982 (median cut); S. P. Lloyd, Least Squares
// Quantization in PCM, 1982.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace overlook::wang_ldi {

using Colour = std::array<uint8_t, 3>;

struct Palette {
    std::vector<Colour> colours;   // at most `most`, from dark to bright
    std::vector<uint8_t> indices;  // [all] of each one the nearest, as far as cells of 4 codes a side tell
};
// most: 1 to 256. Same colours, same palette.
Palette palette_of(std::span<const Colour> all, uint32_t most);

}  // namespace overlook::wang_ldi
