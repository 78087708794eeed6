#include "tools/bake/wang_ldi/stage.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "formats/steady_math.h"
#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

rays::Copy copy_of(const Planted& object, double east_m, double north_m) {
    steady::SinCos turn = steady::sin_cos(double(object.turn_rad));
    float turn_cos = float(turn.cos) * object.scale, turn_sin = float(turn.sin) * object.scale;
    glm::vec3 at(float(double(object.x_m) + east_m), float(double(object.y_m) + north_m), 0);
    return {object.model, glm::mat4x3({turn_cos, turn_sin, 0}, {-turn_sin, turn_cos, 0}, {0, 0, object.scale}, at)};
}

}  // namespace

std::array<int, 9> neighbourhood(const TileSet& set, size_t tile, uint64_t seed, std::span<const std::array<int, 9>> unlike) {
    std::array<int, 9> tiles = alone(tile);
    Random random(seed);
    // Those beside it first, then the corners between them.
    for (int place : {3, 5, 1, 7, 0, 2, 6, 8}) {
        int column = place % 3, row = place / 3;
        auto at = [&](int c, int r) -> const Tile* {
            if (c < 0 || c > 2 || r < 0 || r > 2 || tiles[size_t(3 * r + c)] < 0) return nullptr;
            return &set.tiles[size_t(tiles[size_t(3 * r + c)])];
        };
        const Tile *west = at(column - 1, row), *east = at(column + 1, row), *south = at(column, row - 1),
                   *north = at(column, row + 1);
        auto is_unlike = [&](size_t t) {
            return std::none_of(unlike.begin(), unlike.end(), [&](const auto& other) { return other[size_t(place)] == int(t); });
        };
        int chosen = -1, any = -1;  // of those that fit, unlike the others and at all
        uint32_t fitting = 0, any_fitting = 0;
        for (size_t t = 0; t < set.tiles.size(); ++t) {
            const Tile& one = set.tiles[t];
            bool fits = (!west || west->east == one.west) && (!east || east->west == one.east) &&
                        (!south || south->north == one.south) && (!north || north->south == one.north);
            if (!fits) continue;
            bool is_new = is_unlike(t);
            if (is_new && random.next_below(++fitting) == 0) chosen = int(t);
            if (!is_new && random.next_below(++any_fitting) == 0) any = int(t);
        }
        if (chosen < 0) chosen = any;
        if (chosen < 0) chosen = int(random.next_below(uint32_t(set.tiles.size())));
        tiles[size_t(place)] = chosen;
    }
    return tiles;
}

std::vector<rays::Copy> copies_of(const TileSet& set, const Planting& planting, const std::array<int, 9>& tiles) {
    std::vector<rays::Copy> copies;
    for (const Planted& object : planting.tiles[size_t(tiles[4])]) copies.push_back(copy_of(object, 0, 0));
    for (const Planted& object : overhang(set, planting, size_t(tiles[4]))) copies.push_back(copy_of(object, 0, 0));
    // What neighbours hold of the same objects is there already: the same model at the same place, to the last bit.
    auto key_of = [](const rays::Copy& copy) { return std::tuple(copy.mesh, copy.place[3].x, copy.place[3].y); };
    std::set<std::tuple<uint32_t, float, float>> own;
    for (const rays::Copy& copy : copies) own.insert(key_of(copy));
    for (int place = 0; place < 9; ++place) {
        if (place == 4 || tiles[size_t(place)] < 0) continue;
        double east_m = (place % 3 - 1) * planting.tile_size_m, north_m = (place / 3 - 1) * planting.tile_size_m;
        for (const Planted& object : planting.tiles[size_t(tiles[size_t(place)])])
            if (rays::Copy copy = copy_of(object, east_m, north_m); !own.contains(key_of(copy))) copies.push_back(copy);
    }
    return copies;
}

std::vector<rays::Copy> copies_of_ground(const Planting& planting, std::span<const uint8_t> tiles, uint32_t columns) {
    std::vector<rays::Copy> copies;
    for (size_t t = 0; t < tiles.size(); ++t)
        for (const Planted& object : planting.tiles[tiles[t]])
            copies.push_back(
                copy_of(object, double(t % columns) * planting.tile_size_m, double(t / columns) * planting.tile_size_m));
    return copies;
}

Result<TraceStage> stage_of(const Models& models, std::vector<rays::Copy> copies, uint64_t memory_bytes,
                            rays::Instructions instructions) {
    bool fits = rays::flattened_bytes(models.meshes, copies) <= memory_bytes;
    rays::Layout layout = fits ? rays::Layout::flattened : rays::Layout::instances;
    auto scene = rays::Scene::build(models.meshes, copies, layout, instructions);
    if (!scene) return tl::unexpected(scene.error());
    return TraceStage{std::move(copies), std::move(*scene)};
}

}  // namespace overlook::wang_ldi
