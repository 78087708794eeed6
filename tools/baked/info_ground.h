// What `baked info` says of ground of Wang tiles.
#pragma once

#include <string>

#include "formats/wang_ground.h"

namespace overlook::baked {

std::string ground_json(const wang_ldi::PlantedTiles& ground);
void print_ground(const wang_ldi::PlantedTiles& ground);
// Pictures of it into a folder, which is made where there is none.
Result<void> write_sheet(const wang_ldi::PlantedTiles& ground, const std::string& folder);

}  // namespace overlook::baked
