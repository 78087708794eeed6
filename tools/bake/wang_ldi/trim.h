// Leaves painted on cards: what of a card is never solid is cut off before rays are sent, so that fewer of them meet a card
// only to be told that there is a hole.
#pragma once

#include <cstdint>

#include "tools/bake/wang_ldi/skins.h"

namespace overlook::wang_ldi {

struct TrimReport {
    uint64_t masked_before = 0, masked_after = 0;  // triangles with a mask
    uint64_t solid = 0;                            // of them, those without a hole, which need none
    double area_before_m2 = 0, area_after_m2 = 0;  // of triangles with a mask

    void add(const TrimReport& other);
};

// Cuts each masked triangle to an octagon about its solid texels (a convex outline of eight directions in the picture, texels
// whole and a hundredth wider, so no solid texel is lost, nor any that rounding might reach); it is left out if there is none,
// and loses its mask if all are solid. Left whole where less than a twentieth would go, where its texture shrinks to a line,
// where its corners differ in colour, or where it spans more than 2^22 texels. The same places are solid as before. A mesh of
// which nothing were left keeps its first triangle.
TrimReport trim_to_masks(rays::Mesh& mesh, Skin& skin);

}  // namespace overlook::wang_ldi
