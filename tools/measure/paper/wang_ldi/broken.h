// How a picture differs from what should be seen, both of the same camera.
#pragma once

#include <vector>

#include "formats/wang_scene.h"
#include "runtime/view/camera.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::measure::paper::wang {

struct Broken {
    double hole_share = 0;   // of the pixels that should show something: nothing is shown
    double wrong_share = 0;  // something more than 5 % nearer or farther
};
Broken broken_of(const wang_ldi::Warped& truth, const wang_ldi::Warped& picture);

// Of the pixels that should show something those that do not, though the view of an image has the place within its rim and
// depths (hidden), and those whose place it has not (beyond).
struct HoleCauses {
    double hidden_share = 0, beyond_share = 0;
};
HoleCauses causes_of_holes(const view::Camera& camera, const wang_ldi::PerspectiveView& image, const wang_ldi::Warped& truth,
                           const wang_ldi::Warped& picture);

// E: LDR-FLIP at view::kPixelsPerDegree, both before grey, of the pixels in which either shows something; as bake-wang-ldi
// --judge has it.
std::vector<double> errors_of(const wang_ldi::Warped& truth, const wang_ldi::Warped& picture);

// Share of all pixels whose colours differ.
double differing_share(const wang_ldi::Warped& one, const wang_ldi::Warped& other);

}  // namespace overlook::measure::paper::wang
