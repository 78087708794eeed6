// The three steps of repair that need each other's results.
#pragma once

#include <span>
#include <vector>

#include "tools/bake/mesh.h"
#include "tools/bake/mesh_report.h"

namespace overlook::mesh {

// Drops faces without area and duplicates. Gives for every face left the one that stands the other way round, or kNone.
std::vector<uint32_t> drop_bad_faces(Mesh& mesh, MeshReport& report);

// Turns faces so that neighbours agree. `other_side` as drop_bad_faces gives it. Gives each face's layer: 0 is the front, 1 a
// back side, whose front is the face of the other side; of two such faces the one is the front that need not be turned.
std::vector<uint8_t> orient(Mesh& mesh, std::span<const uint32_t> other_side, MeshReport& report);

// Cuts faces apart where a halfedge structure could not hold them, splits positions, and sets `link`.
void cut(Mesh& mesh, std::span<const uint8_t> layer, MeshReport& report);

}  // namespace overlook::mesh
