// What a chain of levels promises, proven anew against the meshes that it was baked from.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "formats/discrete.h"
#include "tools/bake/caveclod/surface_distance.h"
#include "tools/bake/discrete/drawn_texels.h"
#include "tools/bake/mesh_input.h"

namespace overlook::discrete {

struct LevelProof {
    Rung rung = Rung::mesh;
    uint64_t triangle_count = 0;
    double stated_m = 0;
    caveclod::Distance measured;       // to level 0, part by part
    bool is_broken = false;            // some point is farther than stated
    bool is_proven = false;            // no point is
    double stated_lost = 0, lost = 0;  // shares of level 0's area: of billboards of the view (seen_area.h), else of triangles
    double stated_added = 0, added = 0;
    bool area_is_broken = false;  // of billboards: the view has changed by more than stated
};
struct ChainProof {
    double finest_stated_m = 0;
    caveclod::Distance finest;  // of the levels that have a source, from it, at rest
    bool finest_is_broken = false;
    double moved_most_m = 0;  // of all places at all times tried, how far the farthest is out of the sphere; 0 if none is
    std::vector<LevelProof> levels;

    bool holds() const;
    size_t proven_count() const;  // of the levels below level 0
};

// sources: what the first levels were baked from, level by level; of a chain that was cut, the one mesh. Distances are measured
// on the triangles as they are drawn, those of billboards on the opaque texels of their pictures; the sphere is tried at 64 times
// of the clip. O(F log F) for each level, in parallel. Fails with Exit::bad_input where a picture of billboards cannot be read.
Result<ChainProof> prove(const Chain& chain, std::span<const mesh::MeshFile> sources,
                         const std::function<void(double)>& progress);

}  // namespace overlook::discrete
