// The three steps of repair that need each other's results.
#pragma once

#include <span>
#include <vector>

#include "tools/bake/mesh.h"
#include "tools/bake/mesh/faces.h"
#include "tools/bake/mesh_report.h"

namespace overlook::mesh {

// Drops faces without area and duplicates. Gives for every face left the one that stands the other way round, or kNone.
std::vector<uint32_t> drop_bad_faces(Mesh& mesh, MeshReport& report);

struct Orientation {
    std::vector<uint8_t> layer;  // [F] 0: front; 1: a back side, whose front is the face of the other side
    EdgeGroups edges;            // of the mesh after turning, by layer
};

// Turns faces so that neighbours agree. `other_side` as drop_bad_faces gives it. Of two faces of one place the one is the front
// that need not be turned.
Orientation orient(Mesh& mesh, std::span<const uint32_t> other_side, MeshReport& report);

// Cuts faces apart where a halfedge structure could not hold them, splits positions, sets `link`, and counts what there is then.
void cut(Mesh& mesh, const Orientation& orientation, MeshReport& report);

}  // namespace overlook::mesh
