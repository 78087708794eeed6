// What a baked mesh promises, proven anew against the mesh that it was baked from.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "formats/caveclod.h"
#include "tools/bake/caveclod/prove_cuts.h"
#include "tools/bake/caveclod/prove_seams.h"
#include "tools/bake/mesh.h"

namespace overlook::caveclod {

struct Proof {
    std::string broken_law;                          // of the hierarchy's own (tools/bake/caveclod/cut.h); empty = none
    uint64_t triangle_count = 0;                     // of the source
    uint64_t lost_triangle_count = 0;                // of the source's, missing in the finest cut
    uint64_t foreign_triangle_count = 0;             // in the finest cut, but not of the source
    double finest_stated_m = 0, finest_moved_m = 0;  // of the finest cut: the promise, and how far a corner really moved
    CutsProof cuts;                                  // against the finest cut, which is the source but for that
    SeamsProof seams;                                // of the same cuts' corners

    bool holds() const;
};

// hierarchy: as read from a file. source: as open_mesh gives it. `progress` is called with the share done, from this thread.
// seams: the rule that it was baked by. Cost: that of broken_law, prove_cuts and prove_seams, and O(F log F).
Proof prove(const Hierarchy& hierarchy, const mesh::Mesh& source, const SeamBudget& seams, const ProofOptions& options,
            const std::function<void(double)>& progress);

}  // namespace overlook::caveclod
