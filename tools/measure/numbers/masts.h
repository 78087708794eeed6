// Thin things: is as much of them left as there should be?
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/image.h"

namespace overlook::measure {

// What masts are painted with: red more than twice as strong as green and blue, sRGB-encoded, which light and shade leave so.
bool is_mast_red(uint8_t red, uint8_t green, uint8_t blue);

// Samples along a pixel's side by which masts of a picture of that size are judged: 8, or 4 where a target of eight times the
// size is more than every OpenGL 4.5 has. By four a mast of 0.57 px covers three columns or two, and one of 0.43 px two or one:
// less than half of it is found where three quarters stand.
uint32_t mast_samples_a_side(uint32_t width_px, uint32_t height_px);
// "64 samples a pixel"; where that are fewer, why, and what they are worth.
std::string mast_samples_sentence(uint32_t width_px, uint32_t height_px);

struct MastLoss {
    double mast_px = 0, lost_px = 0;  // areas, pixels
    std::vector<uint8_t> is_lost;     // [height, width] of the pixels
};

// Both pictures have factor x factor samples a pixel, and the same size. A pixel's mast area is the share of its samples that
// show a mast. It is lost where the 5 x 5 pixels round it hold less mast area in `test` than 5/6 of what the 3 x 3 pixels round
// it hold in `reference`: a mast's run through 5 pixels is 5/3 of that through 3, so that one as thick as ever that stands up to
// a pixel beside its place is there, and one that is gone, or thinner than half (5/8 a pixel from the edge of the picture), is
// not. mast_px sums the areas of the reference, lost_px those of the lost pixels alone. factor >= 1 divides both sizes.
// O(samples).
MastLoss mast_loss(const ImageRgb8& test, const ImageRgb8& reference, uint32_t factor);

}  // namespace overlook::measure
