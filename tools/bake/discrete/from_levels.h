// A chain from levels that somebody made by hand, their distance measured.
#pragma once

#include <functional>
#include <span>

#include "formats/result.h"
#include "tools/bake/caveclod/bake.h"
#include "tools/bake/caveclod/surface_distance.h"
#include "tools/bake/discrete/shape.h"
#include "tools/bake/mesh_input.h"

namespace overlook::discrete {

struct LevelsChainOptions {
    caveclod::BakeOptions bake;  // its groups, uv_bits and normal_bits
    double gap = 0.02;           // a bound is at most so much above a distance that some point has ..
    double floor_share = 1e-5;   // .. or this share of the thing's size, whichever is more
    uint64_t most_steps = 1u << 22;
    double enough_m = 0;  // as one_sided_distance
};

struct MeasuredLevel {
    uint64_t triangle_count = 0;
    double least_m = 0, most_m = 0;  // the two-sided distance to level 0: some point is this far, none is farther
};

// files: finest first, 1..kMostLevels. Parts of later levels are known by their names; what moves is what the first one says. The
// error of a level is a proven bound of its two-sided distance to level 0, both as they are drawn, part by part (and of what a
// level has no triangles of, twice the sphere's radius). Fails as caveclod::bake does, and with Exit::bad_input: "tree-2.glb: its
// part sails is not in tree-1.glb".
Result<Chain> chain_from_levels(std::span<const mesh::MeshFile> files, const LevelsChainOptions& options,
                                std::vector<MeasuredLevel>& measured, const std::function<void(double)>& progress);

// The two-sided distance of two levels of a chain, part by part, whatever the clip's time.
caveclod::Distance distance_of_levels(const Chain& chain, const Level& a, const Level& b, const LevelsChainOptions& options);

}  // namespace overlook::discrete
