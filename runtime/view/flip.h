// How different two pictures look to a viewer for whom one is flipped for the other, pixel by pixel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace overlook::view {

// Of the observer: 30 for a 512-pixel window, about 17 degrees of sight. Stands in every report beside the number.
constexpr double kPixelsPerDegree = 30;

// rgb: [height, width, 3] row-major, top row first, sRGB-encoded; width and height at least 1.
struct Rgb8View {
    uint32_t width = 0, height = 0;
    std::span<const uint8_t> rgb;
};

// LDR-FLIP of a test picture against a reference of the same size (asserted): [height, width], 0 (same) .. 1; symmetric.
// pixels_per_degree: 1..1000. The picture's outer pixels continue beyond its border. O(pixels * pixels_per_degree); the same bits
// for any number of threads.
// Source: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", Proc. ACM Computer Graphics and Interactive Techniques (HPG) 3(2), 2020. Ours differs in nothing but the order of
// rounding: filters run separated (the yellow-blue one as two), in float.
std::vector<float> flip_map(const Rgb8View& test, const Rgb8View& reference, double pixels_per_degree = kPixelsPerDegree);

}  // namespace overlook::view
