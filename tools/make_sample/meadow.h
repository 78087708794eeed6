// What grows in a meadow: tufts of grass, dandelions and buttercups.
#pragma once

#include "formats/result.h"
#include "tools/bake/mesh.h"

namespace overlook::sample {

constexpr int kGrasses = 15, kDandelions = 9, kButtercups = 15;

// Their surfaces with their pictures. Fail as png_bytes does.
Result<std::vector<mesh::Surface>> grass_surfaces(uint64_t seed);
Result<std::vector<mesh::Surface>> dandelion_surfaces(uint64_t seed);
Result<std::vector<mesh::Surface>> buttercup_surfaces(uint64_t seed);

// The model of a number, its foot at the origin. Same seed, same mesh.
// A tuft of 44 to 62 bent blades, 0.1 to 0.6 m high, every third one with ears.
mesh::Mesh grass_mesh(uint64_t seed, int number, const std::vector<mesh::Surface>& surfaces);
// A rosette of toothed leaves; buds, yellow heads and, on every third one, globes of fruits with parachutes on masked cards.
mesh::Mesh dandelion_mesh(uint64_t seed, int number, const std::vector<mesh::Surface>& surfaces);
// A branched stem with flowers of five petals; its palmate leaves are masked cards.
mesh::Mesh buttercup_mesh(uint64_t seed, int number, const std::vector<mesh::Surface>& surfaces);

}  // namespace overlook::sample
