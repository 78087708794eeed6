// What `baked info` says of ground of Wang tiles.
#pragma once

#include <string>

#include "formats/wang_ground.h"
#include "formats/wang_ldi.h"
#include "formats/wang_textures.h"

namespace overlook::baked {

std::string ground_json(const wang_ldi::PlantedTiles& ground);
void print_ground(const wang_ldi::PlantedTiles& ground);
// Pictures of it, and of its images and textures if there are any, into a folder, which is made where there is none. file: for
// messages.
Result<void> write_sheet(const std::string& file, const wang_ldi::PlantedTiles& ground, const wang_ldi::ImageReader* images,
                         const wang_ldi::TextureSet* textures, const std::string& folder);

}  // namespace overlook::baked
