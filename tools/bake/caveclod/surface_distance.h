// The two-sided (Hausdorff) distance between two sets of triangles, from below and from above.
#pragma once

#include <cstdint>

#include "tools/bake/caveclod/triangle_tree.h"

namespace overlook::caveclod {

struct Distance {
    double least_m = 0;  // some point is this far away
    double most_m = 0;   // none is farther
};

// The greatest distance of any point of `from` to `to`. Stops when most_m <= least_m * (1 + gap) + floor_m, or after most_steps
// halvings (least and most still hold then). The distance to one triangle is convex, so its maximum over a piece is at a corner;
// pieces are halved where that is not tight enough (M. Guthe, P. Borodin, R. Klein, Fast and Accurate Hausdorff Distance
// Calculation between Meshes, 2005, with the same bounds). With enough_m > 0 it is asked whether most_m <= enough_m: what is
// known to be within that is not looked at closer, and gap and floor count only once some point is known to be farther; the
// answer does not hang on the order of triangles then.
Distance one_sided_distance(const TriangleTree& from, const TriangleTree& to, double gap, double floor_m, uint64_t most_steps,
                            double enough_m = 0);

// The greater of both ways.
Distance two_sided_distance(const TriangleTree& a, const TriangleTree& b, double gap, double floor_m, uint64_t most_steps,
                            double enough_m = 0);

}  // namespace overlook::caveclod
