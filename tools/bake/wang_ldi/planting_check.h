// Whether a planting keeps its word whichever tiles meet: nothing overlaps, and nothing more has a place.
//
// Based on: A. Lagae, P. Dutre, A Comparison of Methods for Generating Poisson Disk Distributions, 2008 (relative radius).
#pragma once

#include <cstdint>
#include <optional>

#include "formats/wang_tiles.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {

// Over every two objects of one tile, of two tiles that may stand side by side, and of two that may meet at a corner.
struct OverlapReport {
    uint64_t neighbourhoods = 0;                        // pairs of tiles that may meet, each tile with itself included
    uint64_t tight_overlaps = 0, packing_overlaps = 0;  // pairs of objects
    double least_tight_gap_m = 0;                       // between tight radii; below 0: overlap
    double least_packing_ratio = 0;                     // distance over the sum of packing radii
    uint64_t looks = 0;                                 // at pairs of objects, and at squares of grids to find them
    bool is_cut_short = false;  // after most_looks: overlaps are so many at least, the least gap and ratio so small at least
};
// In time that grows with the objects where they are spread as plantings are, with their pairs only where all stand together.
constexpr uint64_t kMostLooks = uint64_t(1) << 32;
OverlapReport check_overlaps(const TileSet& set, const Planting& planting, uint64_t most_looks = kMostLooks);

// Whether no two tight radii overlap: two that were found are enough for `broken`, but only who has looked at all knows that it
// holds.
enum class Verdict { hold, broken, unproven };
inline Verdict verdict_of(const OverlapReport& report) {
    if (report.tight_overlaps > 0) return Verdict::broken;
    return report.is_cut_short ? Verdict::unproven : Verdict::hold;
}

// The least distance that any two keep, as a share of the greatest that so many could keep in the plane (a hexagonal grid): of
// one packing radius everywhere, Lagae and Dutre's rho = r / sqrt(1 / (2 sqrt(3) n)) for n objects a unit of area, r half the
// least distance. Of several radii: all scaled by least_packing_ratio, and the share of the ground they cover taken over a
// hexagonal grid's.
double relative_radius(const Planting& planting, const OverlapReport& overlaps);

// Of all tiles: how many have a place left for one more object of the least packing radius that is there, given what stands in
// them and over their edges whatever their neighbours are. 0: nothing more has a place in any tiling, but for rounding (1e-6 of
// the tile's size and 1.5e-4 of that radius). least_radius_m: scaled.
uint32_t tiles_with_a_place(const TileSet& set, const Planting& planting, double least_radius_m);

// How many more objects of `radius_m`, a tile, have a place over a tiling, by throwing darts until nothing has.
double more_per_tile(const Planting& planting, const Tiling& tiling, double radius_m, uint64_t seed);

}  // namespace overlook::wang_ldi
