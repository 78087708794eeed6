// Small pieces that hang together with nothing else, such as twigs: left out where what stays is near enough.
#pragma once

#include "tools/bake/discrete/shape.h"

namespace overlook::discrete {

struct WithoutComponents {
    Shape shape;
    double distance_m = 0;  // no point of what is gone is farther from what stays; 0 if nothing is
    double lost_m2 = 0;
    uint64_t lost_count = 0;
};

// Leaves those components of a shape out of which every point has something within distance_m that stays: in a component that is
// not small (larger than eight times distance_m, or the largest of all), or `beside` it. O(F log F).
WithoutComponents without_small_components(const Shape& shape, const Shape& beside, double distance_m);

}  // namespace overlook::discrete
