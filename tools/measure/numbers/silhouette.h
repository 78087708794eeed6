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
    size_t allowed = 0;                                  // not in count: would be, but for the error that was promised
    size_t thing_px = 0;                                 // pixels of the thing in the reference
    size_t lost_px = 0;                                  // of those, where the test does not show the thing, near borders too
    bool needs_surroundings = false;                     // of those counted, one is so near the outline that `around` may decide
    std::vector<uint8_t> mask;  // [height, width], 0 = none, 1 = background, 2 = another thing, 3 = deeper, 4 = allowed
};

constexpr double kMostPromised_px = 64;

struct HoleRule {
    // What the method promised of this frame: a height field's samples stand at most so far from their places, each straight
    // above or below. 0 for full geometry and for methods that promise nothing of the kind; more than kMostPromised_px counts as
    // that.
    double promised_px = 0;
    // The reference drawn with surroundings_px(promised_px) more pixels on every side, or nullptr: then nothing is known of what
    // stands outside the picture, and whatever could be excused by it is counted.
    const Frame* around = nullptr;
    // Things of one id stand before one another: where the reference's depth steps is the outline of one of them, a border as
    // any other. 1 / depth changes evenly over a plane, however steep: a bend of more than 1 % of it is a step.
    bool has_things_before_things = false;
};

// How far the rule looks beyond a pixel.
uint32_t surroundings_px(double promised_px);

// Pixels that are `thing` (not kBackground) in the reference, farther than 1.5 px from a pixel of it that touches anything else,
// and in the test show background, another thing, or the thing more than 1 % deeper. "Deeper" is against the deepest that the
// reference shows of it within 2.5 px, so that a crest before a valley moved by as much as 1.5 px is no hole. Of these,
// background and deeper ground that the promised error explains (is_within_promise) are not counted, but told as `allowed`: a
// crest that stands lower by as much as was promised. The strict count is count + allowed; with promised_px 0 nothing is allowed.
// A crack has ground above it and stays a hole, however much was promised. Background is an id of its own, which no ground can
// look like: it betrays cracks as magenta behind the ground would. The picture's outline is no border: with `around` the borders
// outside are known, and a hole in the outermost row is one as anywhere else. O(pixels + holes * promised_px).
HolePixels hole_pixels(const Frame& test, const Frame& reference, uint32_t thing, const HoleRule& rule = {});

}  // namespace overlook::measure
