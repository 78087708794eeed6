// One planting at full density, of everything that owns objects.
#pragma once

#include "tools/bake/wang_ldi/plant_parts.h"

namespace overlook::wang_ldi {

using Objects = std::vector<Placed>;

// What stands at every corner, along every edge and in every tile, each in its own frame.
struct OwnedObjects {
    std::vector<Objects> corners, horizontals, verticals;  // [colour]
    std::vector<Objects> interiors;                        // [tile]
};

// Exit::bad_input if something that is wanted in every tile has no place: "oak.obj: per_tile: 3 of packing radius 2 m do not fit
// inside a tile of 6 m; 1 did".
Result<OwnedObjects> plant_once(const TileSet& set, const PlantOptions& options, uint64_t attempt);

}  // namespace overlook::wang_ldi
