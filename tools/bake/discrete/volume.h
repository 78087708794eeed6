// Volumes of visibility over the box of a chain, made from what is known at points of its surfaces.
#pragma once

#include <vector>

#include "tools/bake/discrete/shape.h"

namespace overlook::discrete {

// A point of a level, and how much of its area it stands for.
struct SurfacePoint {
    glm::dvec3 at_m{0};
    double area_m2 = 0;
};
// About `count` points, evenly by area, at least one of each triangle that is not tiny beside an even share. The same each time.
std::vector<SurfacePoint> surface_points(const Chain& chain, const Level& level, size_t count);

// Where the volume's cells are: a cube from the chain's origin, as long as the longest side of the box round all levels.
struct VolumeFrame {
    glm::dvec3 origin_m{0};
    double side_m = 1;
    uint32_t cells = 32;

    size_t cell_of(const glm::dvec3& at_m) const;
    glm::dvec3 middle_m(size_t cell) const;
};
VolumeFrame frame_of(const Chain& chain, uint32_t cells);

// order: of each cell that has a surface, by what it comes early; NaN of the others. weight: of each cell, how much of the
// picture changes when it comes. The values rise with the order so that all of 0..255 pass evenly in weight; cells without a
// surface take their neighbours' mean.
Visibility volume_by_order(const VolumeFrame& frame, std::vector<double> order, const std::vector<double>& weight);

}  // namespace overlook::discrete
