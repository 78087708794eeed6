// What a baked mesh promises, proven anew against the mesh that it was baked from.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formats/caveclod.h"
#include "tools/bake/caveclod/groups.h"
#include "tools/bake/mesh.h"

namespace overlook::caveclod {

// One random legal cut, held against the source.
struct CutCheck {
    uint64_t seed = 0, triangle_count = 0;
    double stated_error_m = 0;
    double least_m = 0, most_m = 0;  // the two-sided distance lies between: exact enough to judge by least_m
};

struct Proof {
    std::string broken_law;               // of the hierarchy's own (tools/bake/caveclod/cut.h); empty = none
    uint64_t triangle_count = 0;          // of the source
    uint64_t lost_triangle_count = 0;     // of the source's, missing in the finest cut
    uint64_t foreign_triangle_count = 0;  // in the finest cut, but not of the source
    double finest_stated_m = 0, finest_moved_m = 0;  // of the finest cut: the promise, and how far a corner really moved
    std::vector<CutCheck> cuts;

    uint64_t broken_cut_count() const;
    bool holds() const;
};

// cut_count random legal cuts, their sizes drawn log-uniform from 0.1 % to 50 % of the triangles, each measured by branch and
// bound to within a twentieth. hierarchy: as read from a file. source: as open_mesh gives it. `progress` as in bake().
// Cost: about O(F log F) a cut.
Proof prove(const Hierarchy& hierarchy, const mesh::Mesh& source, uint32_t cut_count, uint64_t seed,
            const std::function<void(double)>& progress);

}  // namespace overlook::caveclod
