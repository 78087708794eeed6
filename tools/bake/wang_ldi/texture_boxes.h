// A directional texture's texels as boxes that stand on its tile, and what a sight line meets of them.
#pragma once

#include <algorithm>

#include "formats/srgb.h"
#include "formats/wang_textures.h"
#include "tools/bake/wang_ldi/texture_walk.h"

namespace overlook::wang_ldi {

// A box of a texel, as far as it is shown: from low to high above the tile's ground.
struct Box {
    double low_m = 0, high_m = 0;
};
inline Box box_of(const TextureSet& set, const DirectionalTexture& texture, size_t texel) {
    double middle_m = set.height_m(texture.heights[texel][0]), half_m = set.half_height_m(texture.heights[texel][1]);
    return {std::max(set.low_m, middle_m - half_m), std::min(set.high_m, middle_m + half_m)};
}

// Of sight lines, linear; colour times coverage.
struct Seen {
    glm::dvec3 colour{0};
    double coverage = 0;
};

// Front to back along a sight line over the tile (over_tile), until it is covered: of the finest picture.
inline Seen seen_along(const TextureSet& set, const DirectionalTexture& texture, const glm::dvec3& from, const glm::dvec3& along,
                       const glm::dvec2& over) {
    Seen seen;
    walk_texels(from, along, set.tile_m, set.side_px, over.x, over.y, [&](uint32_t t, double begin, double end) {
        Box box = box_of(set, texture, t);
        double a = from.z + begin * along.z, b = from.z + end * along.z;
        if (texture.colours[t][3] == 0 || std::max(a, b) < box.low_m || std::min(a, b) > box.high_m) return true;
        double share = (1 - seen.coverage) * texture.colours[t][3] / 255;
        for (int c = 0; c < 3; ++c) seen.colour[c] += share * linear_from_srgb_code(texture.colours[t][size_t(c)]);
        seen.coverage += share;
        return seen.coverage < 0.999;
    });
    return seen;
}

}  // namespace overlook::wang_ldi
