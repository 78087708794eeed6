// From the list of collapses to the splits that undo them.
#pragma once

#include "tools/bake/caveclod/simplify.h"
#include "tools/bake/caveclod/working_mesh.h"

namespace overlook::caveclod {

// coarsest: what all collapses have left; faces that went have the corners that they went with.
Hierarchy make_rows(const mesh::Mesh& mesh, const Groups& groups, const WorkingMesh& coarsest, const CollapseLog& log);

// The longest chain of splits of which each needs the one before.
uint32_t depth_of(const Hierarchy& hierarchy);

}  // namespace overlook::caveclod
