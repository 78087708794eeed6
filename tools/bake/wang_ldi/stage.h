// A tile among plausible neighbours, ready for rays.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 4 (a tile in context: the middle
// one of 3 x 3).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/result.h"
#include "formats/wang_tiles.h"
#include "tools/bake/rays.h"
#include "tools/bake/wang_ldi/skins.h"

namespace overlook::wang_ldi {

// In the tile's own frame: its south-west corner at the origin.
struct TraceStage {
    std::vector<rays::Copy> copies;
    rays::Scene scene;
};

// The tile and the eight round it, which seed chooses among those that fit edge by edge (a corner may be met by tiles that do not
// fit there if no other fits); row by row from the south, -1: none, for a tile alone. Where another fits than stands there in any
// of `unlike`, one such is chosen.
std::array<int, 9> neighbourhood(const TileSet& set, size_t tile, uint64_t seed, std::span<const std::array<int, 9>> unlike = {});
inline std::array<int, 9> alone(size_t tile) {
    return {-1, -1, -1, -1, int(tile), -1, -1, -1, -1};
}

// The middle tile's own objects and its overhang, which are the same whatever the neighbours, then the neighbours' other ones.
std::vector<rays::Copy> copies_of(const TileSet& set, const Planting& planting, const std::array<int, 9>& tiles);

// Everything that stands on a rectangle of tiles, [rows, columns] from the south-west, whose corner is at the origin.
std::vector<rays::Copy> copies_of_ground(const Planting& planting, std::span<const uint8_t> tiles, uint32_t columns);

// Flattened where that takes at most memory_bytes, else as instances. Fails as rays::Scene::build. models must outlive it.
Result<TraceStage> stage_of(const Models& models, std::vector<rays::Copy> copies, uint64_t memory_bytes,
                            rays::Instructions instructions = rays::Instructions::best);

}  // namespace overlook::wang_ldi
