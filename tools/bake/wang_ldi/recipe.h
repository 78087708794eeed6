// What bake-wang-ldi is told: a file of TOML that names models and how they are planted, on which tiles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/result.h"
#include "tools/bake/wang_ldi/plant.h"
#include "tools/bake/wang_ldi/tile_sets.h"

namespace overlook::wang_ldi {

struct Recipe {
    SetOptions set;
    PlantOptions plant;
    bool is_as_paper = false;        // planting = "paper"
    uint64_t seed = 1;               // of set and planting
    std::vector<std::string> files;  // [models of plant]: paths
    // [models of plant]: of all their surfaces, in place of the files' own.
    std::vector<std::optional<float>> roughness, metallic;
};

// "12", "robinson", "corners": sets tiles and kind. Exit::bad_input: "\"twelve\" is no set of tiles; ...".
Result<void> choose_tiles(const std::string& text, SetOptions& set);

// Paths in it are relative to its folder. Every file it names is there and no folder. Failures are Exit::bad_input, one line with
// file, line and key: "meadow.toml:7: model 2: \"tight_radius\" is not a key here; did you mean \"tight_radius_m\"?",
// "meadow.toml:9: model 2: packing_radius_m: 0 is not a number from 1e-06 to 1e+06".
Result<Recipe> read_recipe(const std::string& path);

}  // namespace overlook::wang_ldi
