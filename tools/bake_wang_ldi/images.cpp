#include "tools/bake_wang_ldi/images.h"

#include <CLI/CLI.hpp>
#include <bit>
#include <charconv>
#include <cmath>

#include "formats/steady_math.h"
#include "tools/bake/mesh_input.h"
#include "tools/bake/wang_ldi/model_of_mesh.h"

namespace overlook::bake_wang_ldi {
namespace {

void add_cell_options(CLI::App& app, ImageArgs& args) {
    app.add_option(
           "--constants", args.constants,
           "chosen: levels, directions and rays follow from the options below. paper: 468 to 62 pixels for the rings at one to "
           "seven tiles, 8 directions, 2.5 million rays an image")
        ->check(CLI::IsMember({"chosen", "paper"}))
        ->capture_default_str();
    app.add_option("--height-px", args.height_px, "Of the picture that images are made for: pixels from top to bottom")
        ->check(command::number_in(1, 1e5))
        ->capture_default_str();
    app.add_option("--fov-y-deg", args.fov_y_deg, "Its field of view from top to bottom")
        ->check(command::number_in(1, 170))
        ->capture_default_str();
    app.add_option("--error-px", args.error_px,
                   "How wide a sample may be in the middle of it, from where its level begins to be shown")
        ->check(command::number_in(0.01, 1000))
        ->capture_default_str();
    app.add_option("--eye-low-m", args.eye_low_m, "Eyes are so high above the ground at least")
        ->check(command::number_in(-1e5, 1e5))
        ->capture_default_str();
    app.add_option("--eye-high-m", args.eye_high_m, "And at most")->check(command::number_in(-1e5, 1e5))->capture_default_str();
    app.add_option("--nearest-m", args.nearest_m, "From an eye to the middle of a tile on the ground (default: 2.5 tiles)")
        ->check(command::number_in(0, 1e5));
    app.add_option("--farthest-m", args.farthest_m, "Likewise, at most (default: 40 tiles)")->check(command::number_in(0, 1e6));
}

void add_sampling_options(CLI::App& app, ImageArgs& args) {
    app.add_option("--level-ratio", args.level_ratio, "How much wider a level's samples are than those of the one before")
        ->check(command::number_in(1.05, 4))
        ->capture_default_str();
    app.add_option("--direction-px", args.direction_px,
                   "By so many pixels, in the middle of the picture, a tile's rim may turn between the middle of a direction and "
                   "where its images end")
        ->check(command::number_in(0.1, 1e5))
        ->capture_default_str();
    app.add_option("--level-fade", args.level_fade,
                   "Levels are sampled for so much beyond their own distances, for players that fade one into the next there: a "
                   "share of the distance (0 to 0.5; the player's --fade)")
        ->check(command::number_in(0, 0.5))
        ->capture_default_str();
    app.add_option("--direction-fade", args.direction_fade,
                   "Likewise directions, a share of the angle between two (the player's --direction-fade)")
        ->check(command::number_in(0, 0.5))
        ->capture_default_str();
    app.add_option("--unseen", args.unseen, "Rays stop when so much of what the eyes see is not yet met, as is estimated")
        ->check(command::number_in(1e-4, 0.9))
        ->capture_default_str();
    app.add_option("--samples", args.samples,
                   "covering: of things thinner than a sample as many as cover, drawn, what they do. all: all that eyes meet, "
                   "which draws them wider (as the paper's constants)")
        ->check(CLI::IsMember({"covering", "all"}))
        ->capture_default_str();
    app.add_option("--neighbourhoods", args.neighbourhoods, "Of other tiles, that each tile is sampled among")
        ->check(CLI::Range(1u, 16u))
        ->capture_default_str();
    command::add_bytes_option(
        app, "--ray-memory", args.ray_memory_bytes,
        "A tile and its neighbours that take more for rays are kept as instances: slower, and the last bit of "
        "a sample may differ (default: 4G)");
    app.add_option(
           "--instructions", args.instructions,
           "best: the fastest that this processor has for rays; on others the last bits of samples differ, and their parts "
           "are not taken. everywhere: those that all have, for the same samples on all that estimate reciprocals alike (rcpps: "
           "processors of one maker do), in a quarter more time")
        ->check(CLI::IsMember({"best", "everywhere"}))
        ->capture_default_str();
    app.add_option("--textures", args.textures,
                   "Texels a side of each tile's directional textures, for beyond the farthest images: 1, 2, 4 .. 256, or none")
        ->capture_default_str();
    app.add_option("--texture-error", args.texture_error,
                   "Rays stop when the colours of a texture's texels are so certain: their standard error over their mean")
        ->check(command::number_in(1e-3, 1))
        ->capture_default_str();
    app.add_flag("--border-images", args.has_border_images, "Besides, images of each tile alone, for where the planting ends");
    app.add_option(
           "--judge", args.judged_views,
           "Warp images for so many random views, spread evenly over levels, directions and tiles, and say how they differ "
           "from what rays see: holes, E (LDR-FLIP)")
        ->check(CLI::Range(0u, 1000000u));
    app.add_option("--trial", args.trial_tiles,
                   "Bake the images of so many tiles only, and no file: to see what all take and how good they are")
        ->check(CLI::Range(1u, 65536u));
    app.add_flag("--rate", args.is_timed,
                 "With --trial: shoot each image's rays once more and do nothing with what they meet, and say at which share of "
                 "that rate images are sampled and lit");
}

void add_light_options(CLI::App& app, ImageArgs& args) {
    app.add_option("--light", args.light, "baked: sun and sky in the colours. later: colours as they are, and normals")
        ->check(CLI::IsMember({"baked", "later"}))
        ->capture_default_str();
    app.add_option(
           "--gloss", args.gloss,
           "by-direction: glossy surfaces (glTF's factors, or roughness and metallic in the recipe) as the middle of each "
           "image's eyes sees them. none: as if they sent light back evenly")
        ->check(CLI::IsMember({"by-direction", "none"}))
        ->capture_default_str();
    app.add_option("--sun-heading-deg", args.sun_heading_deg, "Where the sun stands, clockwise from north")
        ->check(command::number_in(-360, 360))
        ->capture_default_str();
    app.add_option("--sun-elevation-deg", args.sun_elevation_deg, "And how high")
        ->check(command::number_in(1, 90))
        ->capture_default_str();
    app.add_option("--sun-rays", args.sun_rays, "Of each sample")->check(CLI::Range(1u, 256u))->capture_default_str();
    app.add_option("--sky-rays", args.sky_rays, "Of each sample")->check(CLI::Range(1u, 256u))->capture_default_str();
    app.add_option("--leaf-transmission", args.leaf_transmission, "How much light two-sided surfaces let through")
        ->check(command::number_in(0, 1))
        ->capture_default_str();
    app.add_option(
           "--leaves", args.leaves,
           "trimmed: what of a card with a leaf on it is never solid is cut off before rays are sent, which show the same "
           "and take less time. whole: it is not")
        ->check(CLI::IsMember({"trimmed", "whole"}))
        ->capture_default_str();
    app.add_option("--parts", args.parts, "Folder of the images that are done, until all are (default: OUTPUT.parts)");
    app.add_option("--part", args.part,
                   "K/N: bake the K-th of N parts into the folder of --parts and no file; when all are there, bake without it");
}

// Nothing of a model stands out of its tight radius, but for rounding.
Result<void> check_reach(const std::string& path, const rays::Mesh& mesh, float tight_radius_m) {
    double reach_m = 0;
    for (const glm::vec3& position : mesh.positions_m)
        reach_m = std::max(reach_m, std::hypot(double(position.x), double(position.y)));
    if (reach_m <= double(tight_radius_m) * (1 + 1e-5)) return {};
    return bad_input("{}: stands out up to {:.4g} m from its middle, its tight_radius_m is {:g}; raise that or scale the model",
                     path, reach_m, tight_radius_m);
}

// "2/5": part 1 of 5.
bool parse_part(const std::string& text, uint64_t& part, uint64_t& count) {
    const char *at = text.data(), *end = at + text.size();
    auto first = std::from_chars(at, end, part);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != '/') return false;
    auto second = std::from_chars(first.ptr + 1, end, count);
    if (second.ec != std::errc() || second.ptr != end || part < 1 || part > count || count > 1'000'000) return false;
    --part;
    return true;
}

// "32", "none".
bool parse_texture_side(const std::string& text, uint32_t& side_px) {
    side_px = 0;
    if (text == "none") return true;
    const char* end = text.data() + text.size();
    auto read = std::from_chars(text.data(), end, side_px);
    return read.ec == std::errc() && read.ptr == end && std::has_single_bit(side_px) && side_px <= wang_ldi::kMostTextureSide_px;
}

}  // namespace

Result<wang_ldi::Models> read_models(const GroundDone& ground, const ImageArgs& args, wang_ldi::TrimReport& trimmed) {
    wang_ldi::ModelOptions options;
    options.leaf_transmission = float(args.leaf_transmission), options.trims_leaves = args.leaves == "trimmed";
    wang_ldi::Models models;
    for (size_t m = 0; m < ground.recipe.files.size(); ++m) {
        const std::string& path = ground.recipe.files[m];
        options.roughness = ground.recipe.roughness[m], options.metallic = ground.recipe.metallic[m];
        auto file = mesh::open_mesh(path);
        if (!file) return tl::unexpected(file.error());
        if (auto added = wang_ldi::add_model(file->mesh, options, models, &trimmed); !added)
            return tl::unexpected(Error{added.error().exit, path + ": " + added.error().message});
        float tight_radius_m = ground.ground.planting.models[m].tight_radius_m;
        if (auto fits = check_reach(path, models.meshes.back(), tight_radius_m); !fits) return tl::unexpected(fits.error());
    }
    return models;
}

void add_image_options(CLI::App& app, ImageArgs& args) {
    add_cell_options(app, args);
    add_sampling_options(app, args);
    add_light_options(app, args);
}

Result<wang_ldi::ImageBake> image_bake_of(const ImageArgs& args, const std::string& output, uint64_t seed) {
    wang_ldi::ImageBake bake;
    if (args.eye_high_m < args.eye_low_m)
        return bad_command("--eye-high-m {}: is below --eye-low-m {}", args.eye_high_m, args.eye_low_m);
    if (args.farthest_m > 0 && args.farthest_m < args.nearest_m)
        return bad_command("--farthest-m {}: is nearer than --nearest-m {}", args.farthest_m, args.nearest_m);
    if (!args.part.empty() && !parse_part(args.part, bake.part, bake.part_count))
        return bad_command("--part {}: K/N is wanted, K from 1 to N", args.part);
    if (!parse_texture_side(args.textures, bake.textures.side_px))
        return bad_command("--textures {}: 1, 2, 4 .. {} texels a side are wanted, or none", args.textures,
                           wang_ldi::kMostTextureSide_px);
    double focal_px = args.height_px / (2 * steady::tan(args.fov_y_deg * M_PI / 360));
    bake.levels.set.cell = {args.eye_low_m, args.eye_high_m, args.nearest_m, args.farthest_m, focal_px, args.error_px};
    bake.levels.level_ratio = args.level_ratio, bake.levels.direction_px = args.direction_px;
    bake.levels.set.level_fade = float(args.level_fade), bake.levels.set.direction_fade = float(args.direction_fade);
    bake.sampling.unseen_goal = args.unseen, bake.textures.error_goal = args.texture_error;
    bake.neighbourhoods = args.neighbourhoods, bake.judged_views = args.judged_views, bake.trial_tiles = args.trial_tiles;
    bake.is_timed = args.is_timed;
    bake.has_border_images = args.has_border_images, bake.is_relit = args.light == "later";
    bake.is_covering = args.samples == "covering";
    bake.has_gloss = args.gloss == "by-direction";
    double heading = args.sun_heading_deg * M_PI / 180, elevation = args.sun_elevation_deg * M_PI / 180;
    steady::SinCos round = steady::sin_cos(heading), up = steady::sin_cos(elevation);
    bake.light.to_sun = glm::vec3(round.sin * up.cos, round.cos * up.cos, up.sin);
    bake.light.sun_rays = args.sun_rays, bake.light.sky_rays = args.sky_rays;
    if (args.instructions == "everywhere") bake.instructions = rays::Instructions::everywhere;
    bake.memory_bytes = args.ray_memory_bytes, bake.version = command::version();
    bake.seed = seed, bake.parts_folder = args.parts;
    if (args.parts.empty() && args.trial_tiles == 0) bake.parts_folder = output + ".parts";
    if (args.trial_tiles > 0 && !args.part.empty())
        return bad_command("--trial {} and --part {}: give one of them", args.trial_tiles, args.part);
    if (args.is_timed && args.trial_tiles == 0) return bad_command("--rate: times a trial; give --trial too");
    if (args.constants == "paper") take_paper_constants(bake);
    return bake;
}

Result<wang_ldi::ImageReport> add_images(container::Writer& writer, const GroundDone& ground, const ImageArgs& args,
                                         const wang_ldi::ImageBake& bake, const command::Common& common) {
    wang_ldi::TrimReport leaves;
    auto models = read_models(ground, args, leaves);
    if (!models) return tl::unexpected(models.error());
    command::Progress progress(common, "sampling");
    auto report = wang_ldi::bake_images(writer, ground.ground.set, ground.ground.planting, *models, bake,
                                        [&](double share) { progress.set(share); });
    if (report) report->leaves = leaves;
    return report;
}

void add_image_options_in_words(const ImageArgs& args, container::Provenance& provenance) {
    auto add = [&](const char* name, const std::string& value) { provenance.options.emplace_back(name, value); };
    add("constants", args.constants);
    add("view", fmt::format("{} px, {} deg, {} px allowed", args.height_px, args.fov_y_deg, args.error_px));
    add("eyes", fmt::format("{} to {} m up, {} to {} m away", args.eye_low_m, args.eye_high_m, args.nearest_m, args.farthest_m));
    add("level-ratio", fmt::format("{}", args.level_ratio)), add("direction-px", fmt::format("{}", args.direction_px));
    if (args.constants != "paper") add("fades", fmt::format("levels {}, directions {}", args.level_fade, args.direction_fade));
    add("unseen", fmt::format("{}", args.unseen)), add("neighbourhoods", fmt::format("{}", args.neighbourhoods));
    if (args.constants != "paper") add("samples", args.samples);
    add("textures", args.textures);
    if (args.textures != "none") add("texture-error", fmt::format("{}", args.texture_error));
    if (args.has_border_images) add("border-images", "true");
    add_light_options_in_words(args, provenance);
}

void add_light_options_in_words(const ImageArgs& args, container::Provenance& provenance) {
    auto add = [&](const char* name, const std::string& value) { provenance.options.emplace_back(name, value); };
    add("light", args.light);
    if (args.light == "baked")
        add("sun", fmt::format("heading {} deg, elevation {} deg, {} rays, sky {} rays", args.sun_heading_deg,
                               args.sun_elevation_deg, args.sun_rays, args.sky_rays));
    add("leaf-transmission", fmt::format("{}", args.leaf_transmission));
    if (args.gloss != ImageArgs().gloss) add("gloss", args.gloss);
    auto instructions = args.instructions == "everywhere" ? rays::Instructions::everywhere : rays::Instructions::best;
    add("instructions", std::string(rays::name_of(instructions)));
    if (args.leaves != ImageArgs().leaves) add("leaves", args.leaves);
    if (args.ray_memory_bytes != ImageArgs().ray_memory_bytes) add("ray-memory", fmt::format("{}", args.ray_memory_bytes));
}

}  // namespace overlook::bake_wang_ldi
