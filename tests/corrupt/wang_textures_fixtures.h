// A small set of directional textures: whole ones, and for every rule of their section files that break it alone.
#pragma once

#include <string>
#include <vector>

#include "formats/wang_textures_layout.h"
#include "tests/corrupt/wang_images_fixtures.h"

namespace overlook::wang_ldi::texture_fixtures {

using container::fixtures::Bytes;
using container::fixtures::Fixture;

// Of image_fixtures::post(): one texture of 2 x 2 texels, with normals: the worked example of formats/spec/wang_textures.md.
TextureSet post();

std::vector<Fixture> whole_files();
std::vector<Fixture> corrupt_files();

}  // namespace overlook::wang_ldi::texture_fixtures
