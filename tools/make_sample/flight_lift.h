// Flights kept clear of the ground, whatever the ground is.
#pragma once

#include <functional>

#include "formats/scene.h"

namespace overlook::sample {

using GroundHeight = std::function<double(double x_m, double y_m)>;

// Lifts the keys round every frame that is lower than clearance_m over the ground, and in the end, should that not do, all of
// them.
void lift(scene::Flight& flight, const GroundHeight& ground_m, double clearance_m);

// The least height of a flight's frames above the ground.
double least_clearance_m(const scene::Flight& flight, const GroundHeight& ground_m);

}  // namespace overlook::sample
