// How much of the view a thing covers: what distances do not see.
#pragma once

#include <array>

#include "tools/bake/discrete/looks.h"

namespace overlook::discrete {

constexpr size_t kSeenFrom = 13;  // along the axes, the diagonals of a box's sides and its own: opposite ones see the same

// Square metres covered, from each direction, by what is drawn of a shape, its masks' holes left out: by rays a 192th of the
// sphere's width apart. Same arguments, same numbers.
std::array<double, kSeenFrom> seen_areas_m2(const Shape& shape, const Looks& looks, const glm::dvec3& middle_m, double radius_m);

// What a level covers less and more than level 0, on the mean over the directions, as shares of level 0's own area such that
// losing a share s of leaves which hide nothing of each other is a share s: twice what is seen, by all that there is.
struct SeenChange {
    double lost = 0, added = 0;
};
SeenChange seen_change(const std::array<double, kSeenFrom>& finest_m2, const std::array<double, kSeenFrom>& level_m2,
                       double finest_area_m2);

// A level as a shape, as it lies on the chain's grid.
Shape shape_of_level(const Chain& chain, const Level& level);
// Over the chain's sphere, at rest.
std::array<double, kSeenFrom> seen_areas_m2(const Chain& chain, const Level& level, const Looks& looks);

}  // namespace overlook::discrete
