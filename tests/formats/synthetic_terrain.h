// Terrains of any shape, made from a fixed row of numbers: the same on every machine.
#pragma once

#include <cstdint>

#include "formats/terrain.h"

namespace overlook::terrain {

// Says where there is no height.
using VoidTest = bool (*)(uint32_t column, uint32_t row);

inline bool no_void(uint32_t, uint32_t) {
    return false;
}

// Slopes, noise and, here and there, a cliff; codes as rough as the ground below them, nested, and voids marked, as the rules
// ask. The codes promise nothing about the heights. Both sides at least 2.
Terrain synthetic_terrain(uint32_t width, uint32_t height, VoidTest is_void);

}  // namespace overlook::terrain
