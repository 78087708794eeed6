// What a cut relies on in a terrain: checked when a file is read, and again by whoever proves it.
#pragma once

#include <optional>

#include "formats/terrain.h"

namespace overlook::terrain {

struct DiamondPlace {
    uint32_t x = 0, y = 0, level = 0;  // of its split vertex, virtual
};

// The first diamond (coarse to fine) whose error code is above that of a diamond that must be split before it; none in a sound
// terrain.
std::optional<DiamondPlace> find_code_above_parent(const Terrain& terrain);

// The first diamond of level 0, or lone finest triangle, that covers a void without being marked kMustSplit. With nested codes
// none at level 0 means none at any: whatever covers a void splits, at last, into one of level 0 that does.
std::optional<DiamondPlace> find_unmarked_void(const Terrain& terrain);

// The least float that is not below a value.
float float_at_least(double value);

}  // namespace overlook::terrain
