// A mesh in, a hierarchy ready to be written out: groups, collapses, quantising, what follows from them.
#pragma once

#include <functional>

#include "formats/caveclod.h"
#include "tools/bake/caveclod/groups.h"
#include "tools/bake/caveclod/simplify.h"

namespace overlook::caveclod {

struct BakeOptions {
    GroupOptions groups;
    SimplifyOptions simplify;
    Precision precision;
    double source_rounding_m = 0;  // how far the mesh's positions lie from those of its file (MeshReport::rounding_m)
};

// What was found and done, in numbers.
struct BakeReport {
    uint64_t source_face_count = 0, source_position_count = 0;
    uint64_t free_count = 0, sharp_count = 0, rigid_count = 0;  // positions by kind
    uint64_t group_count = 0, packed_count = 0, clique_bound = 0;
    double dense_population = 0;  // of the paper's index array
    uint64_t dense_bytes = 0, rows_bytes = 0;
    // Told before collapsing: under the strict rule by rigid positions and boundary curves; where seams move by borders alone.
    uint64_t floor_face_estimate = 0, budgeted_floor_face_estimate = 0;
    double size_m = 0;                       // diagonal of the box round all positions
    uint64_t face_count_at_one_percent = 0;  // of the coarsest cut with a stated error of at most a hundredth of size_m
    HindranceCounts kept_at_one_percent{};   // its positions by what keeps them
    SimplifyReport simplify;
    Quantised quantised;
};

// Bakes in memory; the hierarchy is quantised, complete and canonical, its errors hold against the file that
// `mesh` was read from: what reading and quantising have moved is in them.
// A pure function of its arguments, for any number of threads. `progress` is called with the share done, 0..1, from this thread;
// `on_floors` once, before the long work, when the groups and the floors are in `report`. Fails as find_groups, build_hierarchy
// and complete do.
Result<Hierarchy> bake(
    const mesh::Mesh& mesh, const BakeOptions& options, BakeReport& report, const std::function<void(double)>& progress,
    const std::function<void()>& on_floors = [] {});

}  // namespace overlook::caveclod
