// What a chain of levels promises, proven anew against the meshes that it was baked from.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "formats/discrete.h"
#include "tools/bake/caveclod/surface_distance.h"
#include "tools/bake/mesh_input.h"

namespace overlook::discrete {

struct LevelProof {
    uint64_t triangle_count = 0;
    double stated_m = 0;
    caveclod::Distance measured;       // to level 0, part by part
    bool is_broken = false;            // some point is farther than stated
    bool is_proven = false;            // no point is
    double stated_lost = 0, lost = 0;  // shares of level 0's area
};
struct ChainProof {
    double finest_stated_m = 0;
    caveclod::Distance finest;  // of the levels that have a source, from it, at rest
    bool finest_is_broken = false;
    double moved_most_m = 0;  // of all places at all times tried, how far the farthest is out of the sphere; 0 if none is
    std::vector<LevelProof> levels;

    bool holds() const;
};

// sources: what the first levels were baked from, level by level; of a chain that was cut, the one mesh. Distances are measured
// on the triangles as they are drawn; the sphere is tried at 64 times of the clip. O(F log F) for each level, in parallel.
ChainProof prove(const Chain& chain, std::span<const mesh::MeshFile> sources, const std::function<void(double)>& progress);

}  // namespace overlook::discrete
