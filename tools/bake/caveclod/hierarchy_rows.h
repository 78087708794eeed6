// From the list of collapses to the splits that undo them.
#pragma once

#include "tools/bake/caveclod/simplify.h"
#include "tools/bake/caveclod/working_mesh.h"

namespace overlook::caveclod {

// coarsest: what all collapses have left; faces that went have the corners that they went with. Fails with Exit::bad_input where
// corners have carried too many looks to one position: "position 7 would have more than 65535 render vertices; ...".
Result<Hierarchy> make_rows(const mesh::Mesh& mesh, const Groups& groups, const WorkingMesh& coarsest, const CollapseLog& log);

// Which attributes a mesh brings; normals are made where it has none.
Attributes attributes_of(const mesh::Mesh& mesh);

// The longest chain of splits of which each needs the one before.
uint32_t depth_of(const Hierarchy& hierarchy);

}  // namespace overlook::caveclod
