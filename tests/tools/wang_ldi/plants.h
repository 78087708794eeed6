// Small plants whose shape is known, on tiles that fit together: for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/wang_ldi.h"
#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/stage.h"

namespace overlook::wang_ldi::plants {

inline void add_triangle(rays::Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    auto first = uint32_t(mesh.positions_m.size());
    for (const glm::vec3& corner : {a, b, c}) mesh.positions_m.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
}

// A ball of `radius` about (0, 0, height), of `rings` x 2 `rings` squares, its corners on the sphere.
inline rays::Mesh ball(float radius, float height, int rings) {
    rays::Mesh mesh;
    auto at = [&](int ring, int step) {
        float polar = float(M_PI) * float(ring) / float(rings), round = float(M_PI) * float(step) / float(rings);
        return glm::vec3(radius * std::sin(polar) * std::cos(round), radius * std::sin(polar) * std::sin(round),
                         height + radius * std::cos(polar));
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int step = 0; step < 2 * rings; ++step) {
            if (ring > 0) add_triangle(mesh, at(ring, step), at(ring + 1, step), at(ring, step + 1));
            if (ring + 1 < rings) add_triangle(mesh, at(ring, step + 1), at(ring + 1, step), at(ring + 1, step + 1));
        }
    return mesh;
}

// An upright cross of two cards, width x height, from the ground on, with round holes.
inline rays::Mesh card(float width, float height) {
    rays::Mesh mesh;
    rays::Mask mask{16, 16, std::vector<uint8_t>(256, 255), 128};
    for (int p = 0; p < 256; ++p)
        if (std::hypot(p % 8 - 3.5, p / 16 % 8 - 3.5) < 2) mask.opacity[size_t(p)] = 0;
    mesh.masks = {mask};
    float half = width / 2;
    for (glm::vec3 side : {glm::vec3(half, 0, 0), glm::vec3(0, half, 0)}) {
        glm::vec3 up(0, 0, height);
        add_triangle(mesh, -side, side, side + up), add_triangle(mesh, -side, side + up, -side + up);
        mesh.uvs.push_back({glm::vec2(0, 1), {1, 1}, {1, 0}}), mesh.uvs.push_back({glm::vec2(0, 1), {1, 0}, {0, 0}});
    }
    mesh.masks_of.assign(mesh.triangles.size(), 0);
    return mesh;
}

inline Skin skin_of(const glm::vec3& albedo, float transmission = 0) {
    Skin skin;
    skin.looks = {{albedo, rays::kNone, transmission}};
    return skin;
}

// Balls on the ground in two colours, and cards.
inline Models models() {
    Models made;
    made.meshes = {ball(0.25f, 0.3f, 12), ball(0.15f, 0.8f, 10), card(0.5f, 0.9f)};
    made.skins = {skin_of({0.7f, 0.3f, 0.1f}), skin_of({0.9f, 0.8f, 0.1f}), skin_of({0.15f, 0.45f, 0.1f}, 0.4f)};
    return made;
}

// One tile that fits itself on all sides, of 4 m, with about 24 objects that reach over no edge.
inline TileSet one_tile() {
    TileSet set;
    set.tiles = {Tile{}};
    return set;
}
inline Planting planting(uint64_t seed, size_t tiles = 1) {
    Planting planting;
    planting.tile_size_m = 4;
    planting.models = {{"ball", 0.25f, 0.3f}, {"high ball", 0.15f, 0.2f}, {"card", 0.25f, 0.3f}};
    Random random(seed);
    for (size_t t = 0; t < tiles; ++t) {
        planting.tiles.emplace_back();
        for (int i = 0; i < 25; ++i) {
            Planted object;
            object.model = random.next_below(3);
            object.x_m = float(0.4 + 0.8 * (i % 5) + 0.14 * (2 * random.next_unit() - 1));
            object.y_m = float(0.4 + 0.8 * (i / 5) + 0.14 * (2 * random.next_unit() - 1));
            object.turn_rad = float(6.28 * random.next_unit()), object.scale = float(0.8 + 0.2 * random.next_unit());
            planting.tiles[t].push_back(object);
        }
    }
    return planting;
}

// A set for it: eyes at 1.5 to 1.9 m, a picture of 400 pixels to the unit of tangent.
inline ImageSet image_set() {
    ImageSet set;
    set.tile_m = 4, set.low_m = 0, set.high_m = 1, set.tile_count = 1, set.direction_count = 4;
    set.cell = {1.5, 1.9, 6, 60, 400, 1};
    set.levels = {{160, 6, 0.006f, 1}, {80, 12, 0.012f, 1}};
    return set;
}

}  // namespace overlook::wang_ldi::plants
