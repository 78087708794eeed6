// What the ground of a shaded relief is made of, by height, slope and form.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/bake/relief_light.h"

namespace overlook::relief {

using Colour = std::array<double, 3>;  // linear light, 0..1

// Linear light from an sRGB colour of 8 bits a channel (IEC 61966-2-1).
Colour linear_from_srgb(uint8_t red, uint8_t green, uint8_t blue);

// The nearest 8-bit sRGB value of a linear-light one, which is clamped to 0..1.
uint8_t srgb_from_linear(double linear);

struct Ground {
    double height = 0;    // 0 at the lowest sample, 1 at the highest
    double relief_m = 0;  // highest less lowest sample: snow needs mountains
    double slope = 0;     // tangent, exaggerated as the light is
    double hollow = 0;    // -1 on crests .. 1 in hollows, against the surroundings near by
    double valley = 0;    // the same against the surroundings farther away
    bool is_water = false;
};

// Meadow and forest below, scree and rock where it is steep, snow on gentle high ground, darker and greener
// in hollows.
Colour ground_colour(const Ground& ground);

// [n] 1 where a cell lies in a level surface of at least least_cells cells, not a thin one (five cells for
// each of its rim), that nothing beside it lies below but for its outlet (at most 3 % of its rim) and that
// does not reach the border with more than a quarter of its rim: a lake. O(n).
std::vector<uint8_t> find_water(const Field& field, uint32_t least_cells);

}  // namespace overlook::relief
