// What `baked info` says of a whole scene's image and the pictures of it by rays.
#pragma once

#include <string>

#include "formats/container.h"
#include "formats/wang_scene.h"

namespace overlook::baked {

std::string scene_json(const container::Reader& file, const wang_ldi::Scene& scene);
void print_scene(const container::Reader& file, const wang_ldi::Scene& scene);

}  // namespace overlook::baked
