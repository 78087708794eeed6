// Planting Wang tiles: where the objects of every corner, every edge and every tile stand, so that nothing overlaps whichever
// tiles meet and the ground is as densely planted across edges and corners as anywhere.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2002, section 3 (two radii; throwing of darts
// round-robin); A. Lagae, P. Dutre, A Procedural Object Distribution Function, 2005 (corners first, then edges, then interiors).
// Ours: radii that differ, areas filled until nothing more has a place, and among several plantings the evenest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/wang_tiles.h"

namespace overlook::wang_ldi {

// How a model is planted.
struct PlantModel {
    std::string name;                                // bare, for messages and the file
    float tight_radius_m = 0, packing_radius_m = 0;  // of scale 1; 0 < tight <= packing
    double weight = 1;                               // its share of all objects, over the sum of weights
    double least_scale = 1, most_scale = 1;          // at random between
    double least_turn_rad = 0, most_turn_rad = 6.283185307179586;
    // 0: anywhere, by weight. Else so many in each tile, first of all and inside only (trees among flowers); its radius counts
    // for no edge.
    uint32_t per_tile = 0;
    std::vector<uint32_t> variants;  // of per_tile: in these variants of a prototile only; empty: in all
};

struct PlantOptions {
    double tile_size_m = 0;
    std::vector<PlantModel> models;
    double density_per_m2 = 0;  // of all by weight; 0: as many as have a place; of the paper's: stops there
    uint64_t seed = 1;
    uint32_t candidates = 64;  // plantings that are made, of which the evenest is kept
    uint32_t tries = 10000;    // of the paper's: at a visit
};

// The greatest packing radius that may stand on an edge; what is planted inside keeps as far from edges. Metres.
double edge_reach_m(const PlantOptions& options);
// The least tile: corners keep apart from each other along an edge. Metres.
double least_tile_size_m(const PlantOptions& options);

struct PlantReport {
    uint32_t candidates = 0, kept = 0;  // how many were made, and which was kept
    double full_density_per_m2 = 0;     // of models by weight: as many as have a place
    double density_per_m2 = 0;          // and what was planted
    uint32_t rounds = 0;                // of the paper's
};

// Corners, then edges, then interiors, each filled until nothing of the least packing radius has a place, then thinned to the
// density asked for and to that of each corner's colour. Same options, same planting. O(candidates * objects). Exit::bad_input:
// "tile_size_m: 1.2 is too small ...", "tile_size_m: 20000 is too large ...", "density_per_m2: 40 a square metre do not fit; 25.3
// do ...".
Result<Planting> plant(const TileSet& set, const PlantOptions& options, PlantReport& report);

// As the paper does it, with its voids at corners. It knows neither corners of less density nor what stands per tile.
// Exit::bad_input: "tile_size_m: ...", "planting: \"paper\" plants no borders ...", "oak.obj: per_tile: ...".
Result<Planting> plant_as_paper(const TileSet& set, const PlantOptions& options, PlantReport& report);

}  // namespace overlook::wang_ldi
