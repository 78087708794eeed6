// In place of the second step of bake-wang-ldi: a whole ground as one perspective image.
#pragma once

#include <string>

#include "runtime/command/command.h"
#include "tools/bake/wang_ldi/bake_scene.h"
#include "tools/bake_wang_ldi/images.h"

namespace overlook::bake_wang_ldi {

struct SceneArgs {
    std::string camera, size = "640x480", layers = "seen";
    double near_m = 0.1, far_m = 0, cell_m = 0.3, merge_share = 0.01;
    uint32_t side_tiles = 40, eyes = 64, directions = 2;
    std::string given;  // an option of these that is on the command line; empty: none is
};

void add_scene_options(CLI::App& app, SceneArgs& args);
// After parsing: what was given.
void note_scene_options(const CLI::App& app, SceneArgs& args);

// What is to be baked; eyes, field of view, light and rays are those of the images' options. Fails with Exit::bad_command:
// "--scene-size 640: WIDTHxHEIGHT is wanted, 1 to 4096 pixels each", "--scene-eyes: goes with --only scene".
Result<wang_ldi::SceneBake> scene_bake_of(const SceneArgs& args, const GroundArgs& ground, const ImageArgs& images,
                                          uint64_t seed);

// Reads the recipe's models and adds the scene's sections to the file.
Result<wang_ldi::SceneMade> add_scene(container::Writer& writer, const GroundDone& ground, const ImageArgs& images,
                                      const wang_ldi::SceneBake& bake, const command::Common& common);

// What of the options decides the bytes, as words.
// view: of scene_bake_of.
void add_scene_options_in_words(const SceneArgs& args, const ImageArgs& images, const wang_ldi::PerspectiveView& view,
                                container::Provenance& provenance);

// A JSON object as text. stored_bytes: of the image in the file.
std::string scene_json(const wang_ldi::SceneMade& made, uint64_t stored_bytes);
void say_scene(const wang_ldi::SceneMade& made, uint64_t stored_bytes, const command::Common& common);

}  // namespace overlook::bake_wang_ldi
