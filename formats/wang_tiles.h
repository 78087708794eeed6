// Wang tiles and what is planted on them: square plots of ground that fit together wherever the colours of their edges agree,
// so that a few of them cover any ground without repeating (tilings: runtime/wang_ldi; choice and planting: tools/bake/wang_ldi).
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2002, sections 2 and 3; A. Lagae, P. Dutre, A
// Procedural Object Distribution Function, 2005 (corners, edges and interiors planted one after the other), and An Alternative
// for Wang Tiles: Colored Edges versus Colored Corners, 2006. Here an edge's colour names the corners it joins, so that both
// kinds of set are one.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace overlook::wang_ldi {

// Colours of a tile's edges: north and south index TileSet::horizontal, east and west TileSet::vertical. Tiles of the same four
// colours are variants of one prototile: they differ inside only.
struct Tile {
    uint8_t north = 0, east = 0, south = 0, west = 0;

    bool operator==(const Tile&) const = default;
};

// The colours of the two corners that an edge joins: low at its west or south end, high at its east or north end. Whoever meets
// at a corner agrees on its colour.
struct EdgeColour {
    uint8_t low = 0, high = 0;

    bool operator==(const EdgeColour&) const = default;
};

struct TileSet {
    std::vector<EdgeColour> horizontal{{}}, vertical{{}};  // 1..255 colours each
    // Of each corner colour (1..255): how densely the ground around it is planted, 0 (bare) .. 1 (as densely as anywhere).
    std::vector<float> corner_density{1};
    std::vector<Tile> tiles;  // 1..255

    bool operator==(const TileSet&) const = default;
};

// Colours of a tile's corners: south-west, south-east, north-west, north-east.
inline std::array<uint8_t, 4> corners_of(const TileSet& set, const Tile& tile) {
    const EdgeColour &south = set.horizontal[tile.south], &north = set.horizontal[tile.north];
    return {south.low, south.high, north.low, north.high};
}

// What is planted. Around an object's middle, of scale 1: nothing of it stands out of its tight radius; no other packing radius
// overlaps its own.
struct Model {
    std::string name;  // the file's bare name, UTF-8
    float tight_radius_m = 0, packing_radius_m = 0;

    bool operator==(const Model&) const = default;
};

// What an object belongs to, and so is the same with: every corner of that colour, every edge of that colour, or one tile.
enum class Owner : uint8_t { corner = 0, horizontal_edge = 1, vertical_edge = 2, interior = 3 };

struct Planted {
    uint32_t model = 0;      // of Planting::models
    float x_m = 0, y_m = 0;  // of its middle: east and north of the tile's south-west corner
    float turn_rad = 0;      // counter-clockwise seen from above, 0..2 pi
    float scale = 1;         // > 0
    Owner owner = Owner::interior;

    bool operator==(const Planted&) const = default;
};

struct Planting {
    double tile_size_m = 0;  // > 0
    std::vector<Model> models;
    // [tiles of the set]: whose middles lie in [0, tile_size_m)^2. Objects of an edge or a corner stand on all sides of it, so
    // that each tile holds its part of them; an interior's reach over no edge.
    std::vector<std::vector<Planted>> tiles;

    bool operator==(const Planting&) const = default;
};

// What stands around a tile whatever its neighbours are: the parts of its edges' and corners' objects that neighbours hold, in
// the tile's own metres, middles outside of [0, tile_size_m)^2. Those of edges first (south, north, west, east), then those of
// corners (as corners_of). A side that no tile of the set has as its opposite gives none.
std::vector<Planted> overhang(const TileSet& set, const Planting& planting, size_t tile);

}  // namespace overlook::wang_ldi
