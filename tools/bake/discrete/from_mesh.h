// A chain from one mesh: levels cut from the hierarchies of its parts, foliage thinned along with them.
#pragma once

#include <functional>

#include "formats/result.h"
#include "tools/bake/caveclod/bake.h"
#include "tools/bake/discrete/foliage.h"
#include "tools/bake/discrete/ladder.h"
#include "tools/bake/discrete/pieces.h"
#include "tools/bake/mesh_input.h"

namespace overlook::discrete {

// Which levels of billboards are tried beside those that are cut (billboards.h).
enum class Impostors { none, cross, cloud, automatic };

struct MeshChainOptions {
    caveclod::BakeOptions bake;  // its position_bits are not used: a chain has 16
    CardOptions cards;
    bool thins_foliage = true;  // cards may be lost, and other small pieces that hang together with nothing (components.h)
    bool grows_foliage = true;  // what stays of them grows
    LadderOptions ladder;
    Impostors impostors = Impostors::none;
    // Levels that are asked for only from where the thing's sphere is less than so many pixels wide are plain (Level::is_plain),
    // but for those of billboards or with masks. 0: none is.
    double plain_px = 0;
};

// A level that was tried.
struct TriedLevel {
    std::string kind;  // "mesh", or that of billboards
    Candidate candidate;
    double lost_area_share = 0, added_area_share = 0;
    Verdict verdict;
};
struct MeshChainReport {
    uint64_t source_triangle_count = 0, part_count = 0, card_count = 0, card_triangle_count = 0;
    double rounding_m = 0;
    std::vector<TriedLevel> tried;  // finest first
};

// Of what a mesh's file moves, the chain's parts: part 0 rests.
std::vector<Part> parts_of(const mesh::Motion& motion);

// Bakes in memory. All levels come from one family: with a distance allowed, each part's solid pieces are cut from its hierarchy
// within it, small ones left out where what stays is within it, and each part's cards are lost and grow within it. The error of a
// level is the lesser of that distance as it came out and of a measurement from above (surface_distance.h; not where thin things
// are kept, SimplifyOptions), and holds twice what laying it on 16 bits moved. That of a level of billboards (billboards.h) is
// measured from above as it is stored, by its texels. A pure function of its arguments, for any number of threads. Fails as
// caveclod::bake does, and with Exit::impossible for more than kMostParts parts.
Result<Chain> chain_from_mesh(const mesh::MeshFile& file, const MeshChainOptions& options, MeshChainReport& report,
                              const std::function<void(double)>& progress);

}  // namespace overlook::discrete
