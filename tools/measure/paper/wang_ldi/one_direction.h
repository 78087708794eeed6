// One image for every side, of which what faces away is skipped, beside one for each of eight sides.
#pragma once

#include "tools/measure/paper/wang_ldi/broken.h"
#include "tools/measure/paper/wang_ldi/subject.h"

namespace overlook::measure::paper::wang {

// A picture of the same ground by either.
struct DirectionsRow {
    uint64_t bytes = 0;                         // of all images, stored
    uint64_t tiles = 0, samples = 0, kept = 0;  // of the picture; kept: those that are warped
    double warp_ms = 0;                         // one thread; of what is kept
    uint64_t shown_px = 0;                      // pixels that show something
    Broken beside_eight;                        // of what eight directions show
};
struct OneDirection {
    DirectionsRow eight, one, one_facing;  // one_facing: without samples whose normals point away from the eye
};

// An image without the samples that face away from the eye. south_west_m: of its tile, at height 0.
wang_ldi::Ldi facing(const wang_ldi::ImageSet& set, uint32_t level, const wang_ldi::Ldi& ldi, const glm::dvec3& eye_m,
                     const glm::dvec2& south_west_m);

// Both bakes have normals. Fails as Wood::make and Wood::draw, and with Exit::bad_input where there are none: "a/one.ovl: has no
// normals; bake it with --light later".
Result<OneDirection> compare_directions(const Bake& one, const Bake& eight, uint64_t seed);

}  // namespace overlook::measure::paper::wang
