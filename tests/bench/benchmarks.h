// All benchmarks, by room; each file says what it counts as work and as the least bytes that must move.
#pragma once

#include <cstdint>
#include <string>

namespace overlook::bench {

void add_bake(const std::string& landscape);
void add_files(const std::string& landscape, const std::string& folder);
void add_refinement(const std::string& landscape);
void add_view();
// side: of a grid of rough ground of 2 * side * side triangles.
void add_bake_mesh(uint32_t side);
// side: of a grid of hills of 2 * side * side triangles.
void add_caveclod(uint32_t side);
// side: of a tiling of side * side tiles.
void add_wang(uint32_t side);
// small: images an eighth as wide.
void add_warp(bool small);
// side_px: of the pictures.
void add_numbers(uint32_t side_px);

}  // namespace overlook::bench
