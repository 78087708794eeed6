// Two pictures compared pixel by pixel: luma, its mean difference, PSNR.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/view/flip.h"
#include "tools/measure/frame.h"

namespace overlook::measure {

// Wherever two pictures are compared they have the same size: that is the caller's duty (asserted).
using RgbView = view::Rgb8View;
inline RgbView rgb_of(const Frame& frame) {
    return {frame.width, frame.height, frame.rgb};
}

// L: [height, width], 0..1. Rec. 709 coefficients (0.2126, 0.7152, 0.0722) on the sRGB-encoded values, not linearised: near
// enough to equal steps of lightness, and a grey pixel v of 255 is v / 255.
std::vector<float> luma_of(const RgbView& picture);

// Mean over pixels of |L_a - L_b|, 0..1. 0 for the same picture, 1 for black against white.
double luma_difference_mean(const RgbView& a, const RgbView& b);

// 10 log10(1 / mean square difference) over all pixels and channels in 0..1, decibels; infinity for the same picture, 0 for
// black against white.
double psnr_db(const RgbView& a, const RgbView& b);

}  // namespace overlook::measure
