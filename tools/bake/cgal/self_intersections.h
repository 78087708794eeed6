// What only exact geometry can say of a mesh. In a library of its own, which a build may leave out (OVERLOOK_CGAL): CGAL's
// polygon mesh processing is under the GPL.
#pragma once

#include <cstdint>

#include "tools/bake/mesh.h"

namespace overlook::mesh {

// How many pairs of faces of a repaired mesh cross or overlap each other beyond the positions and edges that they share. Pairs
// that meet at a position which repair split are not counted: they were neighbours. Exact otherwise. Repair takes meshes that
// cross themselves as they are, so this is for reports. Cost O(F log F + pairs of faces whose boxes meet). Sources: CGAL 5.5,
// "Polygon Mesh Processing", self_intersections; A. Zomorodian, H. Edelsbrunner, "Fast Software for Box Intersections",
// International Journal of Computational Geometry and Applications 12, 2002.
uint64_t self_intersection_count(const Mesh& mesh);

}  // namespace overlook::mesh
