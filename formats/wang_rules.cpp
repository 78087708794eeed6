#include <array>
#include <cmath>
#include <optional>

#include "formats/wang_layout.h"

namespace overlook::wang_ldi {
namespace {

constexpr std::array<std::string_view, 10> kRules{
    "The file's kind is WANG and it has the sections WTIL and WPLT.",
    "WTIL has 1 to 255 colours of horizontal edges, of vertical edges and of corners, 1 to 255 tiles, and no byte more or less.",
    "Densities of corners are 0 to 1.",
    "Every edge's colour joins corner colours that are there.",
    "A tile's edges have colours that are there, and they agree about its corners.",
    "WPLT is of 2^28 bytes at most and decodes to exactly the models and the tiles stated, as many as the set has, with "
    "printable "
    "names of at most 4,096 bytes.",
    "The tile's size is 1e-6 to 1e6 metres, and of each model 0 < tight radius <= packing radius <= the tile's size.",
    "An object is of a model that is there, has its middle in its tile, a turn of 0 to 2 pi, a scale of 1e-6 to 1e6 and a known "
    "owner.",
    "Objects of an edge, or of a corner, are the same in every tile that has one of its colour there.",
    "An interior's tight radius reaches over no edge of its tile.",
};
constexpr double kTwoPi = 6.2831855;
// Of a tile's size, for rounding to single precision.
constexpr double kSlack = 1e-6;

bool is_between(double value, double low, double high) {
    return value >= low && value <= high;
}  // false for NaN

Fault fault_of_object(const Planting& planting, size_t tile, size_t i) {
    const Planted& object = planting.tiles[tile][i];
    double size = planting.tile_size_m, x = double(object.x_m), y = double(object.y_m);
    bool is_fine = object.model < planting.models.size() && x >= 0 && x < size && y >= 0 && y < size &&
                   is_between(double(object.turn_rad), 0, kTwoPi) && is_between(double(object.scale), 1e-6, 1e6) &&
                   object.owner <= Owner::interior;
    if (!is_fine)
        return {8,
                fmt::format("tile {}: object {} is of model {} (there are {}), at ({}, {}) of {} m, turned by {}, scaled by {}, "
                            "of owner {}",
                            tile, i, object.model, planting.models.size(), x, y, size, object.turn_rad, object.scale,
                            uint32_t(object.owner))};
    double tight = double(planting.models[object.model].tight_radius_m) * double(object.scale);
    double edge = std::min(std::min(x, size - x), std::min(y, size - y));
    if (object.owner == Owner::interior && tight > edge + kSlack * size)
        return {10, fmt::format("tile {}: object {} has a tight radius of {} m, {} m from an edge", tile, i, tight, edge)};
    return {};
}

// A tile's part of what a side or a corner owns: 0 to 3 south, north, west, east; 4 to 7 corners as corners_of.
std::vector<Planted> part_of(const Planting& planting, size_t tile, int part) {
    std::vector<Planted> owned;
    for (const Planted& object : planting.tiles[tile]) {
        bool is_east = double(object.x_m) >= planting.tile_size_m / 2, is_north = double(object.y_m) >= planting.tile_size_m / 2;
        int of = object.owner == Owner::horizontal_edge ? (is_north ? 1 : 0)
                 : object.owner == Owner::vertical_edge ? (is_east ? 3 : 2)
                 : object.owner == Owner::corner        ? 4 + 2 * is_north + is_east
                                                        : -1;
        if (of == part) owned.push_back(object);
    }
    return owned;
}

uint8_t colour_of(const TileSet& set, const Tile& tile, int part) {
    const std::array<uint8_t, 4> sides{tile.south, tile.north, tile.west, tile.east};
    return part < 4 ? sides[size_t(part)] : corners_of(set, tile)[size_t(part - 4)];
}

Fault fault_of_sides(const TileSet& set, const Planting& planting) {
    static constexpr const char* kParts[] = {"south",      "north",      "west",       "east",
                                             "south-west", "south-east", "north-west", "north-east"};
    for (int part = 0; part < 8; ++part) {
        std::array<std::optional<size_t>, 256> first;
        for (size_t t = 0; t < set.tiles.size(); ++t) {
            std::optional<size_t>& same = first[colour_of(set, set.tiles[t], part)];
            if (!same) {
                same = t;
                continue;
            }
            if (part_of(planting, t, part) != part_of(planting, *same, part))
                return {9,
                        fmt::format("tiles {} and {} have the same colour in the {}, and other objects", *same, t, kParts[part])};
        }
    }
    return {};
}

}  // namespace

std::string_view rule_text(int rule) {
    return rule >= 1 && rule <= rule_count() ? kRules[size_t(rule - 1)] : std::string_view();
}
int rule_count() {
    return int(kRules.size());
}

Fault fault_of_counts(const TileSet& set) {
    auto is_fine = [](size_t count, size_t most) { return count >= 1 && count <= most; };
    if (is_fine(set.horizontal.size(), kMostColours) && is_fine(set.vertical.size(), kMostColours) &&
        is_fine(set.corner_density.size(), kMostColours) && is_fine(set.tiles.size(), kMostTiles))
        return {};
    return {2, fmt::format("{} colours of horizontal edges, {} of vertical ones, {} of corners, {} tiles", set.horizontal.size(),
                           set.vertical.size(), set.corner_density.size(), set.tiles.size())};
}

Fault fault_of_set(const TileSet& set) {
    size_t corners = set.corner_density.size();
    for (size_t c = 0; c < corners; ++c)
        if (!is_between(double(set.corner_density[c]), 0, 1))
            return {3, fmt::format("corner colour {} has a density of {}", c, set.corner_density[c])};
    for (const auto* edges : {&set.horizontal, &set.vertical})
        for (size_t c = 0; c < edges->size(); ++c)
            if ((*edges)[c].low >= corners || (*edges)[c].high >= corners)
                return {4, fmt::format("a colour of {} edges, {}, joins corners {} and {}, there are {}",
                                       edges == &set.horizontal ? "horizontal" : "vertical", c, (*edges)[c].low, (*edges)[c].high,
                                       corners)};
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        const Tile& tile = set.tiles[t];
        if (std::max(tile.north, tile.south) >= set.horizontal.size() || std::max(tile.east, tile.west) >= set.vertical.size())
            return {5, fmt::format("tile {} has colours {} {} {} {}, there are {} and {}", t, tile.north, tile.east, tile.south,
                                   tile.west, set.horizontal.size(), set.vertical.size())};
        const EdgeColour &west = set.vertical[tile.west], &east = set.vertical[tile.east];
        if (std::array<uint8_t, 4>{west.low, east.low, west.high, east.high} != corners_of(set, tile))
            return {5, fmt::format("tile {} has edges that disagree about its corners", t)};
    }
    return {};
}

Fault fault_of_models(const Planting& planting) {
    double size = planting.tile_size_m;
    if (!is_between(size, 1e-6, 1e6)) return {7, fmt::format("tiles are {} m large", size)};
    for (size_t m = 0; m < planting.models.size(); ++m) {
        auto tight = double(planting.models[m].tight_radius_m), packing = double(planting.models[m].packing_radius_m);
        if (!(tight > 0 && tight <= packing && packing <= size))
            return {7, fmt::format("model {} has a tight radius of {} m, a packing radius of {} m, tiles of {} m", m, tight,
                                   packing, size)};
    }
    return {};
}

Fault fault_of_objects(const TileSet& set, const Planting& planting) {
    if (planting.tiles.size() != set.tiles.size())
        return {6, fmt::format("{} tiles are planted, the set has {}", planting.tiles.size(), set.tiles.size())};
    for (size_t t = 0; t < planting.tiles.size(); ++t)
        for (size_t i = 0; i < planting.tiles[t].size(); ++i)
            if (Fault fault = fault_of_object(planting, t, i)) return fault;
    return fault_of_sides(set, planting);
}

}  // namespace overlook::wang_ldi
