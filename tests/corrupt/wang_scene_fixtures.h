// A small scene: whole ones, and for every rule of its sections files that break it alone.
#pragma once

#include <string>
#include <vector>

#include "formats/wang_scene_layout.h"
#include "tests/corrupt/container_fixtures.h"

namespace overlook::wang_ldi::scene_fixtures {

using container::fixtures::Bytes;
using container::fixtures::Fixture;

constexpr uint32_t kTileCount = 3;  // of the set that the scene's tiles are of

// Two tiles, an image of 3 x 2 pixels and a picture of 2 x 1: the worked example of formats/spec/wang_scene.md.
Scene two_tiles();

std::vector<Fixture> whole_files();
std::vector<Fixture> corrupt_files();

}  // namespace overlook::wang_ldi::scene_fixtures
