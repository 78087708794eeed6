// What `baked info` says and shows of layered depth images of Wang tiles.
#pragma once

#include <string>
#include <vector>

#include "formats/image.h"
#include "formats/wang_ground.h"
#include "formats/wang_ldi.h"
#include "formats/wang_textures.h"

namespace overlook::baked {

std::string images_json(const wang_ldi::ImageReader& images);
void print_images(const wang_ldi::ImageReader& images);

std::string textures_json(const wang_ldi::TextureSet& set);
void print_textures(const wang_ldi::TextureSet& set);

struct NamedPicture {
    std::string name;  // "tiles-above.png"
    ImageRgb8 picture;
};
// tiles-above.png, tiles-aside.png, directions.png, levels.png: runtime/wang_ldi/portraits.h. Fails as those, the file named.
Result<std::vector<NamedPicture>> image_sheet(const std::string& file, const wang_ldi::ImageReader& images,
                                              const wang_ldi::PlantedTiles& ground);

}  // namespace overlook::baked
