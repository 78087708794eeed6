// The colours of FLIP: from sRGB to opponent channels, from those to perceived differences. Rows of floats in, rows out.
#pragma once

#include <cstddef>
#include <cstdint>

namespace overlook::view {

// YCxCz without its offset and factors, which a linear filter does not see: Y, X - Y and Y - Z, each relative to the white D65.
struct OpponentRow {
    float *y, *red_green, *yellow_blue;
};
void opponent_from_srgb(const uint8_t* rgb, size_t width, const OpponentRow& out);

// CIE L*a*b* with a* and b* scaled by 0.01 L*, as colours fade in the dark (Hunt).
struct HuntRow {
    float *l, *a, *b;
};
// Colours outside what the screen shows (filters make such) are clamped to it in linear RGB. `out` may be `in`.
void hunt_from_opponent(const OpponentRow& in, size_t width, const HuntRow& out);

// HyAB distance ^ 0.7, mapped so that 0..0.4 of the greatest (green to blue) take 0..0.95: 0..1.
void colour_difference(const HuntRow& a, const HuntRow& b, size_t width, float* out);

}  // namespace overlook::view
