// Sets of Wang tiles: one tile that repeats, the stochastic sets of the paper chosen by search, corners of several colours,
// ground that ends, and the aperiodic sixteen of Robinson as a comparison.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2002, section 2; A. Lagae, P. Dutre, An
// Alternative for Wang Tiles: Colored Edges versus Colored Corners, 2006; S. Labbe, Metallic Mean Wang Tiles II: the Dynamics of
// an Aperiodic Computer Chip, 2025 (theorem C, n = 1: the sixteen tiles that R. Ammann found and R. M. Robinson published, from a
// formula).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/wang_tiles.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {

enum class SetKind { stochastic, robinson, corners };

struct SetOptions {
    SetKind kind = SetKind::stochastic;
    // Of a stochastic set: in all; 1 (which repeats), or a multiple of horizontal_colours * vertical_colours, 2 for each pair of
    // colours to the west and to the south at least.
    uint32_t tiles = 12;
    uint32_t horizontal_colours = 2, vertical_colours = 2;
    // Of corners: their densities, 2 to 3 of them; a tile for every four.
    std::vector<float> corner_density{1, 1};
    // Adds a bare corner, and tiles for where the planting ends: any ground's border can be followed.
    bool has_borders = false;
    uint32_t variants = 1;      // of each prototile
    uint64_t seed = 1;          // of the search
    uint32_t candidates = 500;  // how many sets are looked at where there are more than can be counted out
};

// What a search came to.
struct SearchReport {
    uint64_t candidates = 0;     // balanced sets that were looked at
    bool is_exhaustive = false;  // these were all there are
    double best = 0, worst = 0;  // greatest_correlation, of the best and the worst
    uint64_t dead_ending = 0;    // of them: those for which avoiding equal neighbours may dead-end
};

// Same options, same set. Exit::bad_command: "12 tiles are no multiple of 9 ...", "... 324 tiles, a file holds 255 at most".
Result<TileSet> make_tile_set(const SetOptions& options, SearchReport& report);

// Every set of `per_pair` tiles for each pair of a west and a south colour, 2 x 2 colours, in which every colour is as often on a
// north edge and as often on an east edge as the other: 148 for two, in a fixed order.
std::vector<TileSet> balanced_sets(uint32_t per_pair);

// greatest_correlation of the set's row-by-row tiling of side x side, equal neighbours allowed, as the paper does it.
double score_of(const TileSet& set, uint32_t side, uint64_t seed);

// Densities of corners, above 0, at which ground is one tile over and over, though the set has others: descending.
std::vector<float> repeated_densities(const TileSet& set);

// Robinson's sixteen, six colours each way.
TileSet robinson_set();
// A tiling with them: of theorem C, at (x0, y0) = (seeds). Row by row they dead-end at once.
Tiling robinson_tiling(const TileSet& set, uint32_t columns, uint32_t rows, uint64_t seed);

// "0100 1000 ...": north, east, south, west of each tile.
std::string text_of(const TileSet& set);

}  // namespace overlook::wang_ldi
