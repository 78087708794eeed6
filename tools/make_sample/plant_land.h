// Gentle hills for tiles of plants to stand on: an elevation model, its picture, a scene of both and a walk over them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/scene.h"
#include "tools/make_sample/sample_plants.h"

namespace overlook::sample {

constexpr uint32_t kLandSide = 321;  // samples
constexpr double kLandCell_m = 2.5;

// Height at so many metres from the north-western corner; slopes of at most 0.25.
double land_height_m(uint64_t seed, double east_m, double south_m);

// land.tif and land.png for bake-lod terrain; weeds: how much of the earth is green, 0..1. The second fails as png_bytes does.
std::vector<std::byte> land_tiff(uint64_t seed);
Result<std::vector<std::byte>> land_png(double weeds, uint64_t seed);

// land.ovl with planting.ovl on it; models: NAME.ovl of each plant of the set.
scene::Scene land_scene(const PlantSet& set, uint64_t seed);
// Across the middle of the land at eye_m above the ground.
scene::Flight land_walk(double eye_m, uint64_t seed);

}  // namespace overlook::sample
