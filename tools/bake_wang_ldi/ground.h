// The first step of bake-wang-ldi: a recipe into a set of tiles and what is planted on them, measured.
#pragma once

#include <string>

#include "formats/wang_ground.h"
#include "runtime/command/command.h"
#include "tools/bake/wang_ldi/figures.h"
#include "tools/bake/wang_ldi/recipe.h"

namespace overlook::wang_ldi {
struct ImageReport;
struct SceneMade;
}  // namespace overlook::wang_ldi
namespace overlook::bake_wang_ldi {

struct GroundArgs {
    std::string recipe, output;
    std::string only;             // "planting", "scene": no images of the tiles
    std::string tiles, planting;  // in place of the recipe's; empty: that
    bool has_seed = false;        // --seed in place of the recipe's
    bool has_borders = false;
    uint32_t variants = 0, colours = 0;  // 0: the recipe's
    bool measures = false;               // spectra too
};

struct GroundDone {
    wang_ldi::Recipe recipe;
    wang_ldi::PlantedTiles ground;
    wang_ldi::SearchReport search;
    wang_ldi::PlantReport plant;
    wang_ldi::Figures figures;
    double set_s = 0, plant_s = 0, measure_s = 0;
};

void add_ground_options(CLI::App& app, GroundArgs& args);

// Reads the recipe, chooses the set, plants and measures.
Result<GroundDone> make_ground(const GroundArgs& args, const command::Common& common);

// Whence the file is: options that decide its bytes, the recipe and the models.
Result<container::Provenance> provenance_of(const GroundArgs& args, const GroundDone& done);

// JSON on stdout, or lines on stderr. images, scene: of the second step, or null; of the scene's image, how many bytes it takes.
void report_ground(const GroundArgs& args, const GroundDone& done, uint64_t bytes, const wang_ldi::ImageReport* images,
                   const wang_ldi::SceneMade* scene, uint64_t scene_bytes, const command::Common& common);

}  // namespace overlook::bake_wang_ldi
