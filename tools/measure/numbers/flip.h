// E: how different two pictures look when one is flipped for the other, pixel by pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/measure/numbers/picture.h"

namespace overlook::measure {

// Of the observer: 30 for a 512-pixel window, about 17 degrees of sight. Stands in every report beside the number.
constexpr double kPixelsPerDegree = 30;

struct FlipError {
    uint32_t width = 0, height = 0;
    std::vector<float> map;  // [height, width], 0 (same) .. 1
    double mean = 0, p99 = 0, max = 0;
};

// LDR-FLIP of a test picture against a reference of the same size; symmetric. pixels_per_degree: 1..1000. The picture's outer
// pixels continue beyond its border. O(pixels * pixels_per_degree); the same bits for any number of threads.
// Source: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", Proc. ACM Computer Graphics and Interactive Techniques (HPG) 3(2), 2020. Ours differs in nothing but the order of
// rounding: filters run separated (the yellow-blue one as two), in float.
FlipError flip(const RgbView& test, const RgbView& reference, double pixels_per_degree = kPixelsPerDegree);

}  // namespace overlook::measure
