// Which planes a thing's cards lie in.
//
// Based on: X. Decoret, F. Durand, F. Sillion, J. Dorsey, Billboard Clouds for Extreme Model Simplification, 2003 (planes chosen
// greedily by how much of the thing lies near them and faces them). Different here: what is gained by a plane is counted in the
// triangles that the simplified thing would have there, and pieces that no few planes cover stay meshes.
#pragma once

#include <span>
#include <vector>

#include "tools/bake/discrete/card.h"

namespace overlook::discrete {

// Faces that share a place hang together.
struct Components {
    std::vector<uint32_t> of_face;  // [F]
    uint32_t count = 0;
};
Components components_by_place(const Shape& shape);
// Those of another shape whose vertices stand where vertices of the first do: components of that one.
std::vector<uint32_t> components_of_cut(const Shape& finest, const Components& components, const Shape& cut);

struct Covering {
    std::vector<CardPlane> planes;
    std::vector<uint8_t> is_covered;  // [components] wholly within distance_m of the planes, face by face
};
// Planes such that each covers, within distance_m, faces worth more than `least_worth`. worth: [components], what is saved by
// covering one; those that the planes cover only in part are left. O(planes * normals tried * F).
Covering cover(const Shape& shape, const Components& components, const std::vector<double>& worth, double distance_m,
               double least_worth);

// Planes across a thing along x, y and z, such that every place is within distance_m of one of the first axis's; those of the
// other two stand `stride` times as far apart.
std::vector<CardPlane> slabs(const Shape& shape, double distance_m, int stride);

}  // namespace overlook::discrete
