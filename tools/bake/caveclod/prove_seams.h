// The corners of random legal cuts held to the source's own.
#pragma once

#include <cstdint>
#include <functional>

#include "tools/bake/caveclod/prove_cuts.h"
#include "tools/bake/caveclod/seam_error.h"

namespace overlook::caveclod {

struct SeamsProof {
    uint64_t corner_count = 0;   // drawn in all cuts
    uint64_t carried_count = 0;  // of them without a render vertex that the source has there for the face's own surface group
    uint64_t wrong_count = 0;    // of these beyond what the budget allows; under the strict rule all of them
    SeamError worst;             // of those that are carried
    double greatest_shift_m = 0;
};

// Draws the cuts that prove_cuts draws. A corner is the source's own if the finest cut has, at its position and in its face's
// surface group, a corner that looks the same. Any other must have come, with the seam, from some corner of that group no farther
// away than the cut's stated error: whichever of these makes the least of the budget is taken, and both the corner's attributes
// and what the face draws nearest to that place are held against it. Same hierarchy and options, same answer for any number of
// threads. Cost: cut_count * (F log F + carried corners * corners of their group within the stated error).
SeamsProof prove_seams(
    const Hierarchy& hierarchy, const SeamBudget& budget, const ProofOptions& options,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace overlook::caveclod
