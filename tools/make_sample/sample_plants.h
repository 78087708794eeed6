// make-sample sunflowers and grass: the plants of section 6 of J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth
// Images, ready to be planted on tiles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/result.h"
#include "tools/bake/mesh.h"

namespace overlook::sample {

// A model of a set, how often it stands among the others, how it may be scaled and turned.
struct Plant {
    std::string file;  // "sunflower-03.glb"
    mesh::Mesh mesh;
    double share = 1;
    double least_scale = 1, most_scale = 1;
    double least_turn_deg = 0, most_turn_deg = 360;
};

struct PlantSet {
    std::vector<Plant> plants;
    double per_tile = 20;  // how many stand on a tile
};

constexpr double kSunflowersPerTile = 20;  // of kSunflowerTriangles each
constexpr double kGrassTileTriangles = 62'000;

// "sunflowers" (11 models) or "grass" (15 tufts of grass, 9 dandelions, 15 buttercups). Fails as png_bytes does.
Result<PlantSet> plant_set(const std::string& name, uint64_t seed);

// The farthest that any of it is from the axis through its foot.
double tight_radius_m(const mesh::Mesh& mesh);

// The same and a little more: discs of it are not to overlap.
double packing_radius_m(const Plant& plant);

// What bake-wang-ldi is to make of the set: each model with its radii, and a tile of which the packing discs of per_tile of them
// cover 0.6. (Discs thrown at random jam at 0.547: J. Feder, Random Sequential Adsorption, 1980. Planted where there is room,
// more fit.)
std::string plant_recipe(const PlantSet& set, uint64_t seed);

struct PlantOptions {
    uint64_t seed = 1;
    uint32_t count = 7000;  // of plants in the scene, 1..100000: as many as the paper's viewer sees at once
};

// Writes into a folder, which it makes where there is none, and returns the paths: the models (GLB), recipe.toml, README.md with
// the commands, for drawing them as geometry hills.glb, scene.json (of the chains of levels baked beside it) and flight.json, and
// for drawing them as tiles land.tif, land.png, planting.json and walk.json (plant_land.h).
// Fails with Exit::cannot_write.
Result<std::vector<std::string>> make_plants(const std::string& name, const PlantOptions& options, const std::string& folder);

}  // namespace overlook::sample
