#include "tools/bake/wang_ldi/stage.h"

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

constexpr float kSame_m = 1e-3f;

rays::Copy copy_of(const Planted& object, double east_m, double north_m) {
    float turn_cos = std::cos(object.turn_rad) * object.scale, turn_sin = std::sin(object.turn_rad) * object.scale;
    glm::vec3 at(float(double(object.x_m) + east_m), float(double(object.y_m) + north_m), 0);
    return {object.model, glm::mat4x3({turn_cos, turn_sin, 0}, {-turn_sin, turn_cos, 0}, {0, 0, object.scale}, at)};
}

}  // namespace

std::array<int, 9> neighbourhood(const TileSet& set, size_t tile, uint64_t seed) {
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
        int chosen = -1;
        uint32_t fitting = 0;
        for (size_t t = 0; t < set.tiles.size(); ++t) {
            const Tile& one = set.tiles[t];
            bool fits = (!west || west->east == one.west) && (!east || east->west == one.east) &&
                        (!south || south->north == one.south) && (!north || north->south == one.north);
            if (fits && random.next_below(++fitting) == 0) chosen = int(t);
        }
        if (chosen < 0) chosen = int(random.next_below(uint32_t(set.tiles.size())));
        tiles[size_t(place)] = chosen;
    }
    return tiles;
}

std::vector<rays::Copy> copies_of(const TileSet& set, const Planting& planting, const std::array<int, 9>& tiles) {
    std::vector<rays::Copy> copies;
    for (const Planted& object : planting.tiles[size_t(tiles[4])]) copies.push_back(copy_of(object, 0, 0));
    for (const Planted& object : overhang(set, planting, size_t(tiles[4]))) copies.push_back(copy_of(object, 0, 0));
    size_t own = copies.size();
    // What neighbours hold of the same objects is there already.
    auto is_there = [&](const rays::Copy& copy) {
        return std::any_of(copies.begin(), copies.begin() + long(own), [&](const rays::Copy& other) {
            return other.mesh == copy.mesh && glm::distance(other.place[3], copy.place[3]) < kSame_m;
        });
    };
    for (int place = 0; place < 9; ++place) {
        if (place == 4 || tiles[size_t(place)] < 0) continue;
        double east_m = (place % 3 - 1) * planting.tile_size_m, north_m = (place / 3 - 1) * planting.tile_size_m;
        for (const Planted& object : planting.tiles[size_t(tiles[size_t(place)])])
            if (rays::Copy copy = copy_of(object, east_m, north_m); !is_there(copy)) copies.push_back(copy);
    }
    return copies;
}

Result<TraceStage> stage_of(const Models& models, std::vector<rays::Copy> copies, uint64_t memory_bytes) {
    bool fits = rays::flattened_bytes(models.meshes, copies) <= memory_bytes;
    auto scene = rays::Scene::build(models.meshes, copies, fits ? rays::Layout::flattened : rays::Layout::instances);
    if (!scene) return tl::unexpected(scene.error());
    return TraceStage{std::move(copies), std::move(*scene)};
}

}  // namespace overlook::wang_ldi
