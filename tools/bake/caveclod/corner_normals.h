// The normal at each corner of a mesh: the file's own, brought together where asked, and made where it has none.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "tools/bake/caveclod/mesh_edges.h"
#include "tools/bake/mesh.h"

namespace overlook::caveclod {

// [3F] of length 1. Own normals of length 1 (within 1e-6) stay as they are, to the last bit. A made one is the mean over the
// corners round its position that are reached across edges at which the surface turns by at most crease_deg, weighted so that it
// is exact on spheres (N. Max, Weights for Computing Vertex Normals from Facet Normals, 1999); only corners without a normal of
// their own take part. weld_deg: as GroupOptions::weld_normals_deg. O(F).
std::vector<glm::vec3> corner_normals(const mesh::Mesh& mesh, const MeshEdges& edges, double crease_deg, double weld_deg);

}  // namespace overlook::caveclod
