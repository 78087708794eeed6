// S and hole pixels: does the outline stand where it should, and does the ground show through?
#pragma once

#include <cstdint>
#include <vector>

#include "tools/measure/frame.h"

namespace overlook::measure {

struct SilhouetteError {
    double p95_px = 0, max_px = 0;  // the greater of both directions each
    size_t test_border_px = 0, reference_border_px = 0;
};

// Two-sided Hausdorff distance between the surface/background borders of two frames of the same size. A border pixel shows a
// surface and has background left, right, above or below; the picture's own outline is none. Neither has a border: 0. One alone:
// its pixels are measured to the nearest place outside the picture, where alone the other's could be. O(pixels).
SilhouetteError silhouette_error(const Frame& test, const Frame& reference);

struct HolePixels {
    size_t count = 0;                                    // the sum of the next three
    size_t background = 0, other_thing = 0, deeper = 0;  // what the test shows instead
    size_t thing_px = 0;                                 // pixels of the thing in the reference
    size_t lost_px = 0;                                  // of those, where the test does not show the thing, near borders too
    std::vector<uint8_t> mask;  // [height, width], 0 = none, 1 = background, 2 = another thing, 3 = deeper
};

// Pixels that are `thing` (not kBackground) in the reference, farther than 1.5 px from a pixel of it that touches anything else,
// and in the test show background, another thing, or the thing more than 1 % deeper. "Deeper" is against the deepest that the
// reference shows of it within 2.5 px, so that a crest before a valley moved by as much as 1.5 px is no hole. O(pixels).
HolePixels hole_pixels(const Frame& test, const Frame& reference, uint32_t thing);

}  // namespace overlook::measure
