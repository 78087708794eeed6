// How the sections of Wang ground are laid out: what writer and reader share. Documented in formats/spec/wang_tiles.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/container.h"
#include "formats/wang_ground.h"

namespace overlook::wang_ldi {

constexpr container::Tag kTilesTag = container::tag("WTIL");
constexpr container::Tag kPlantingTag = container::tag("WPLT");
// What a reader of ground knows: its own sections, and those of the images of its tiles.
inline constexpr container::Tag kKnownTags[] = {kTilesTag,
                                                kPlantingTag,
                                                container::tag("WLDI"),
                                                container::tag("WLDS"),
                                                container::tag("WLDT"),
                                                container::tag("WSCN"),
                                                container::tag("WSCP"),
                                                container::tag("PROV")};

// WTIL: counts of colours of horizontal edges, vertical edges and corners, and of tiles (4 u16); a density for each corner colour
// (f32); low and high of each horizontal and each vertical colour (2 u8); north, east, south, west of each tile (4 u8).
constexpr size_t kTilesHeadBytes = 8;
constexpr uint32_t kMostColours = 255, kMostTiles = 255;

// WPLT: tile_size_m (f64), counts of models and of tiles (2 u32); of each model its name (size as u32, bytes), tight and packing
// radius (2 f32); of each tile its count of objects (u32) and the objects.
constexpr size_t kPlantedBytes = 24;  // model (u32), x, y, turn, scale (4 f32), owner (u32)
constexpr uint32_t kMostModels = 65536, kNameBytesMax = 4096;
constexpr uint64_t kPlantingBytesMax = uint64_t(1) << 28;

// Which rule something breaks, and how; rule 0: none.
struct Fault {
    int rule = 0;
    std::string text;
    explicit operator bool() const { return rule != 0; }
};

std::vector<std::byte> bytes_of_tiles(const TileSet& set);
// Rules W2; bytes may be hostile, no more memory is taken than they can hold.
Fault tiles_of_bytes(std::span<const std::byte> bytes, TileSet& set);
std::vector<std::byte> bytes_of_planting(const Planting& planting);
uint64_t byte_count_of_planting(const Planting& planting);  // how many they are
// Rule W6.
Fault planting_of_bytes(std::span<const std::byte> bytes, Planting& planting);

// The rules that hold of any ground, whether it was read or is to be written. Each looks at what the ones before it left right.
Fault fault_of_counts(const TileSet& set);                             // W2
Fault fault_of_set(const TileSet& set);                                // W3 to W5
Fault fault_of_models(const Planting& planting);                       // W7
Fault fault_of_objects(const TileSet& set, const Planting& planting);  // W6 (as many tiles), W8 to W10

}  // namespace overlook::wang_ldi
