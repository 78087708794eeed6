// The second step of bake-wang-ldi: ground into layered depth images of its tiles.
#pragma once

#include <string>

#include "runtime/command/command.h"
#include "tools/bake/wang_ldi/bake_images.h"
#include "tools/bake_wang_ldi/ground.h"

namespace overlook::bake_wang_ldi {

struct ImageArgs {
    std::string constants = "chosen";
    double height_px = 720, fov_y_deg = 60, error_px = 1;  // of the picture that is thought of
    double eye_low_m = 1.5, eye_high_m = 1.9, nearest_m = 0, farthest_m = 0;
    double level_ratio = 1.5, direction_px = 170, unseen = 0.02;
    double level_fade = 0.05, direction_fade = 0.1;
    uint32_t neighbourhoods = 1, judged_views = 0, trial_tiles = 0;
    std::string textures = "32";  // texels a side, or "none"
    double texture_error = 0.04;
    std::string leaves = "trimmed", instructions = "best";
    std::string light = "baked", gloss = "by-direction", samples = "covering";
    double sun_heading_deg = 140, sun_elevation_deg = 50, leaf_transmission = 0.35;
    uint32_t sun_rays = 8, sky_rays = 32;
    bool has_border_images = false, is_timed = false;
    uint64_t ray_memory_bytes = uint64_t(4) << 30;
    std::string parts, part;  // folder of what is done; "K/N"
};

void add_image_options(CLI::App& app, ImageArgs& args);

// What is to be baked. Fails with Exit::bad_command: "--part 5/3: K/N is wanted, K from 1 to N".
Result<wang_ldi::ImageBake> image_bake_of(const ImageArgs& args, const std::string& output, uint64_t seed);

// The recipe's models; what was trimmed of them is added to `trimmed`. Fails as their readers.
Result<wang_ldi::Models> read_models(const GroundDone& ground, const ImageArgs& args, wang_ldi::TrimReport& trimmed);

// Reads the recipe's models and adds the images' sections to the file.
Result<wang_ldi::ImageReport> add_images(container::Writer& writer, const GroundDone& ground, const ImageArgs& args,
                                         const wang_ldi::ImageBake& bake, const command::Common& common);

// What of the options decides the bytes, as words.
void add_image_options_in_words(const ImageArgs& args, container::Provenance& provenance);

// Those of light, models and rays alone.
void add_light_options_in_words(const ImageArgs& args, container::Provenance& provenance);

// A JSON object as text.
std::string images_json(const wang_ldi::ImageReport& report);
void say_images(const wang_ldi::ImageReport& report, const command::Common& common);

}  // namespace overlook::bake_wang_ldi
