// What decides the bytes of a bake, as one number: for the names of its parts.
#pragma once

#include <cstdint>

#include "tools/bake/wang_ldi/bake_images.h"

namespace overlook::wang_ldi {

// A hash of all of it; of rows as they lie in memory, for a key that never leaves this machine.
uint64_t key_of(const TileSet& tiles, const Planting& planting, const Models& models, const ImageBake& bake, const ImageSet& set);

}  // namespace overlook::wang_ldi
