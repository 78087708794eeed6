#include "formats/wang_tiles.h"

#include <span>

namespace overlook::wang_ldi {
namespace {

// Adds the objects of `owner` that stand in the square [low, high)^2 of a tile, moved by whole tiles.
struct Mover {
    double size_m;
    std::vector<Planted>& into;

    void add(std::span<const Planted> from, Owner owner, std::array<bool, 2> high_half, std::array<int, 2> move_tiles) {
        for (Planted object : from) {
            bool is_east = double(object.x_m) >= size_m / 2, is_north = double(object.y_m) >= size_m / 2;
            bool is_here = owner == Owner::corner            ? is_east == high_half[0] && is_north == high_half[1]
                           : owner == Owner::horizontal_edge ? is_north == high_half[1]
                                                             : is_east == high_half[0];
            if (object.owner != owner || !is_here) continue;
            object.x_m = float(double(object.x_m) + move_tiles[0] * size_m);
            object.y_m = float(double(object.y_m) + move_tiles[1] * size_m);
            into.push_back(object);
        }
    }
};

template <typename Fits>
size_t first_tile(const TileSet& set, Fits fits) {
    size_t t = 0;
    while (t < set.tiles.size() && !fits(set.tiles[t])) ++t;
    return t;
}

}  // namespace

std::vector<Planted> overhang(const TileSet& set, const Planting& planting, size_t tile) {
    std::vector<Planted> around;
    Mover mover{planting.tile_size_m, around};
    const Tile& own = set.tiles[tile];
    auto add = [&](size_t from, Owner owner, std::array<bool, 2> high_half, std::array<int, 2> move_tiles) {
        if (from < set.tiles.size()) mover.add(planting.tiles[from], owner, high_half, move_tiles);
    };
    add(first_tile(set, [&](const Tile& t) { return t.north == own.south; }), Owner::horizontal_edge, {false, true}, {0, -1});
    add(first_tile(set, [&](const Tile& t) { return t.south == own.north; }), Owner::horizontal_edge, {false, false}, {0, 1});
    add(first_tile(set, [&](const Tile& t) { return t.east == own.west; }), Owner::vertical_edge, {true, false}, {-1, 0});
    add(first_tile(set, [&](const Tile& t) { return t.west == own.east; }), Owner::vertical_edge, {false, false}, {1, 0});

    std::array<uint8_t, 4> corners = corners_of(set, own);
    for (int corner = 0; corner < 4; ++corner)
        for (int quadrant = 0; quadrant < 4; ++quadrant) {
            // The tile to this quadrant of the corner holds, at its own opposite corner, that quarter of its objects.
            int east = corner & 1, north = corner >> 1, side_x = quadrant & 1, side_y = quadrant >> 1;
            std::array<int, 2> move_tiles{east + side_x - 1, north + side_y - 1};
            if (move_tiles[0] == 0 && move_tiles[1] == 0) continue;
            size_t opposite = size_t(2 * (1 - side_y) + (1 - side_x));
            size_t from = first_tile(set, [&](const Tile& t) { return corners_of(set, t)[opposite] == corners[size_t(corner)]; });
            add(from, Owner::corner, {side_x == 0, side_y == 0}, move_tiles);
        }
    return around;
}

}  // namespace overlook::wang_ldi
