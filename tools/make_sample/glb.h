// Meshes as GLB files: materials, pictures, nodes that turn.
#pragma once

#include <string>
#include <vector>

#include "tools/bake/mesh.h"

namespace overlook::sample {

// A mesh with normals (and uv, or none) at every corner, placed at at_m, and perhaps turning about an axis there.
struct GlbNode {
    std::string name;
    mesh::Mesh mesh;
    glm::dvec3 at_m{0};
    glm::dvec3 axis{0};  // of length 1; 0: it rests
};

// Metres and z up become glTF's y up. turn_s: how long a whole turn of the nodes with an axis takes. All nodes have the same
// surfaces, whose pictures go into the file. Same nodes, same bytes.
std::string glb_text(const std::vector<GlbNode>& nodes, double turn_s);

}  // namespace overlook::sample
