// What the paper's terrains have in common: textures, recipe, and the variant whose boundaries are as long as the paper's.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/make_sample/ground_textures.h"
#include "tools/make_sample/sample_terrains.h"

namespace overlook::sample {

constexpr double kTile_m = 10'000;  // that a texture covers before it is repeated
constexpr uint32_t kTexture_px = 512;

inline glm::vec2 tile_uv(const glm::dvec3& at_m) {
    return {float(at_m.x / kTile_m), float(-at_m.y / kTile_m)};
}

// Of the variants 0..47 of a mesh that need exactly the paper's packed ids, within one point of the paper's population: the one
// whose number of render vertices is nearest to the paper's, of the first twelve; or the first of the others where those have
// none.
Result<mesh::Mesh> nearest_to_paper(const PaperTerrain& paper, uint64_t seed,
                                    const std::function<mesh::Mesh(uint32_t variant)>& make);

// A surface for each kind with its texture, named after it.
Result<void> dress_surfaces(std::span<const GroundKind> kinds, uint64_t seed, mesh::Mesh& mesh);

std::string terrain_recipe(const PaperTerrain& paper, uint64_t seed, const std::string& made_from);

// Means over windows of 2 reach + 1 either way, cut off at the border. values: [rows, columns].
std::vector<double> box_mean(std::span<const double> values, uint32_t columns, uint32_t rows, uint32_t reach);

}  // namespace overlook::sample
