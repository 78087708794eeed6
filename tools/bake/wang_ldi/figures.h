// What is measured of ground of Wang tiles: how it repeats, whether it keeps its word, how even it is.
#pragma once

#include <string>
#include <vector>

#include "tools/bake/wang_ldi/evenness.h"
#include "tools/bake/wang_ldi/periodicity.h"
#include "tools/bake/wang_ldi/planting_check.h"
#include "tools/bake/wang_ldi/point_spectrum.h"
#include "tools/bake/wang_ldi/recipe.h"

namespace overlook::wang_ldi {

// A set's tiling as it is meant to be used: Robinson's by its formula, others row by row, without equal neighbours where that
// never dead-ends (the eight: as the paper), within the planting where the set has borders.
struct UsedTiling {
    Tiling tiling;
    bool avoids_equal_neighbours = false;
};
Result<UsedTiling> used_tiling(const TileSet& set, const SetOptions& options, uint32_t side, uint64_t seed);

struct Figures {
    // Of tilings.
    Correlation correlation;  // lags 2 to 10, 1,024 x 1,024 tiles
    SpectrumShape spectrum;   // 256 x 256
    NeighbourCount neighbours;
    bool avoids_equal_neighbours = false;
    uint32_t block = 0;            // RandomTiling::block; 0: no random access
    std::string no_random_access;  // why not
    // Of plantings, over all legal neighbourhoods and tiles.
    ZoneDensity zones;
    double edge_reach_m = 0;
    std::vector<double> by_edge_distance, by_corner_distance;  // steps of edge_reach_m / 2
    OverlapReport overlaps;
    double relative_radius = 0;
    uint32_t tiles_with_a_place = 0;
    double more_per_tile = 0;
    // Of their spectra: this, and a Poisson disk set of one packing radius thrown as a whole; empty where radii differ.
    PointSpectrum power, plain_power;
    uint32_t border_tiles = 0;  // with some, but not only bare corners
    uint64_t border_bytes = 0;  // of their planting, uncompressed
};
// with_spectra: else the last but the borders are left out, which take most of the time.
Result<Figures> measure_ground(const TileSet& set, const Planting& planting, const Recipe& recipe, bool with_spectra);

}  // namespace overlook::wang_ldi
