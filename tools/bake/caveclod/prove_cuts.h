// A hierarchy held to its word: random legal cuts, each measured against the source.
#pragma once

#include <cstdint>
#include <functional>

#include "tools/bake/caveclod/cut.h"

namespace overlook::caveclod {

struct ProofOptions {
    uint64_t cut_count = 200;
    uint64_t seed = 1;
    // Face counts are drawn log-uniform between these shares of the source's.
    double least_share = 0.001, most_share = 0.5;
    uint64_t steps = 0;  // halvings in search of a farther point, each cut and way; 0: corners alone
};

struct CutsProof {
    uint64_t cut_count = 0, broken_count = 0;
    uint64_t first_broken_seed = 0;                                             // random_cut's
    uint64_t face_count = 0, turned_count = 0;                                  // drawn in all cuts; of them is_turned
    double greatest_measured_share = 0;                                         // measured over stated: above 1 is broken
    double median_stated_over_measured = 0, greatest_stated_over_measured = 0;  // of cuts with a measurable distance
};

// The i-th of the cuts that a proof draws.
Applied proof_cut(const Hierarchy& hierarchy, const ProofOptions& options, uint64_t i);

// Draws the cuts and measures the two-sided distance of each to the finest cut, from below: a measured distance above the stated
// error (by more than the rounding of positions) breaks the promise. The finest cut stands for the source, so finest_error_m is
// not tried. Faces that are turned from that source (turned_faces.h) are counted. `progress` is called with the share done, 0..1,
// from this thread. Same hierarchy and options, same answer for any number of threads. O(cut_count * F log F).
CutsProof prove_cuts(
    const Hierarchy& hierarchy, const ProofOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace overlook::caveclod
