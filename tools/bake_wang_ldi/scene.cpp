#include "tools/bake_wang_ldi/scene.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/numbers.h"
#include "formats/wang_scene_layout.h"
#include "runtime/view/camera.h"

namespace overlook::bake_wang_ldi {
namespace {

constexpr const char* kOptions[] = {"--scene-tiles", "--scene-camera", "--scene-size",   "--scene-near-m", "--scene-far-m",
                                    "--scene-eyes",  "--scene-cell-m", "--scene-layers", "--scene-merge",  "--scene-views"};

// "640x480".
bool parse_size(const std::string& text, uint32_t& width_px, uint32_t& height_px) {
    const char* end = text.data() + text.size();
    auto is_side = [](uint32_t side_px) { return side_px >= 1 && side_px <= wang_ldi::kMostPerspectiveSide_px; };
    auto width = std::from_chars(text.data(), end, width_px);
    if (width.ec != std::errc() || width.ptr == end || *width.ptr != 'x' || !is_side(width_px)) return false;
    auto height = std::from_chars(width.ptr + 1, end, height_px);
    return height.ec == std::errc() && height.ptr == end && is_side(height_px);
}

Result<wang_ldi::PerspectiveView> view_of(const SceneArgs& args, const ImageArgs& images) {
    wang_ldi::PerspectiveView view;
    view.position_m = {0, 0, (images.eye_low_m + images.eye_high_m) / 2};
    view.heading_deg = 25, view.pitch_deg = -4, view.fov_y_deg = images.fov_y_deg;
    if (!args.camera.empty()) {
        auto camera = view::parse_camera(args.camera);
        if (!camera)
            return bad_command("--scene-camera {}: x,y,z,heading,pitch[,fov_y] are wanted, in metres and degrees", args.camera);
        view.position_m = camera->position_m, view.pitch_deg = camera->pitch_deg;
        view.heading_deg = std::remainder(camera->heading_deg, 360.0);
        // A camera without a field of view has the images'.
        if (std::count(args.camera.begin(), args.camera.end(), ',') > 4) view.fov_y_deg = camera->fov_y_deg;
    }
    if (!parse_size(args.size, view.width_px, view.height_px))
        return bad_command("--scene-size {}: WIDTHxHEIGHT is wanted, 1 to {} pixels each", args.size,
                           wang_ldi::kMostPerspectiveSide_px);
    view.near_m = args.near_m, view.far_m = args.far_m;
    if (args.far_m > 0 && args.far_m < 1.01 * args.near_m)
        return bad_command("--scene-far-m {}: is not beyond --scene-near-m {}", args.far_m, args.near_m);
    wang_ldi::PerspectiveLdi of_view;
    of_view.view = view;
    if (args.far_m == 0) of_view.view.far_m = 2 * view.near_m;  // the ground's is not known yet
    if (wang_ldi::ImageFault fault = wang_ldi::fault_of_view(of_view))
        return bad_command("--scene-camera {}: {}", args.camera, fault.text);
    // Of the pictures nothing but how many samples each pixel has.
    uint64_t pictures = 1 + uint64_t(args.directions) * std::size(wang_ldi::kPictureDistances_m);
    uint64_t least_bytes = pictures * 2 * view.width_px * view.height_px;
    if (least_bytes > wang_ldi::kMostSceneBytes)
        return impossible("--scene-size {}: {} pictures take {} bytes at least, more than 2^28; ask for smaller or fewer "
                          "(--scene-views)",
                          args.size, pictures, with_commas(least_bytes));
    return view;
}

}  // namespace

void add_scene_options(CLI::App& app, SceneArgs& args) {
    app.add_option("--scene-tiles", args.side_tiles, "With --only scene: so many tiles along each side of the ground")
        ->check(CLI::Range(2u, wang_ldi::kMostSceneTiles))
        ->capture_default_str();
    app.add_option("--scene-camera", args.camera,
                   "Of its image: x,y,z,heading,pitch[,fov_y] in metres from the ground's middle (east, north, up) and degrees "
                   "(default: there, as high as the middle of the eyes, 25 degrees clockwise from north, 4 down)");
    app.add_option("--scene-size", args.size, "Of its image and pictures")->type_name("WxH")->capture_default_str();
    app.add_option("--scene-near-m", args.near_m, "Nothing nearer is in them, along the camera's axis")
        ->check(command::number_in(1e-3, 1e5))
        ->capture_default_str();
    app.add_option("--scene-far-m", args.far_m, "Nor anything farther (default: the ground's farthest corner)")
        ->check(command::number_in(1e-3, 1e6));
    app.add_option("--scene-layers", args.layers,
                   "seen: its image has what eyes about the camera see. all: every surface along the rays of its pixels")
        ->check(CLI::IsMember({"seen", "all"}))
        ->capture_default_str();
    app.add_option("--scene-eyes", args.eyes, "So many, the camera's own among them; 1: what it sees itself")
        ->check(CLI::Range(1u, 4096u))
        ->capture_default_str();
    app.add_option("--scene-cell-m", args.cell_m, "So far off it at most, along each axis")
        ->check(command::number_in(0, 1000))
        ->capture_default_str();
    app.add_option("--scene-merge", args.merge_share,
                   "What lies in one pixel becomes one sample where depths differ by so much of the nearer at most")
        ->check(command::number_in(0, 1))
        ->capture_default_str();
    app.add_option(
           "--scene-views", args.directions,
           "Pictures by rays, to hold images against: one from the camera's own place, and so many at each of 0.25, 0.5, 1, "
           "2, 4 and 8 m from it")
        ->check(CLI::Range(0u, 64u))
        ->capture_default_str();
}

void note_scene_options(const CLI::App& app, SceneArgs& args) {
    for (const char* option : kOptions)
        if (args.given.empty() && app.count(option) > 0) args.given = option;
}

Result<wang_ldi::SceneBake> scene_bake_of(const SceneArgs& args, const GroundArgs& ground, const ImageArgs& images,
                                          uint64_t seed) {
    if (ground.only != "scene" && !args.given.empty()) return bad_command("{}: goes with --only scene", args.given);
    auto view = view_of(args, images);
    if (!view) return tl::unexpected(view.error());
    auto of_images = image_bake_of(images, ground.output, seed);
    if (!of_images) return tl::unexpected(of_images.error());
    wang_ldi::SceneBake bake;
    bake.side_tiles = args.side_tiles, bake.view = *view, bake.directions = args.directions;
    bake.image = {seed, args.eyes, args.cell_m, args.merge_share};
    if (args.layers == "all") bake.image.layers = wang_ldi::Layers::all;
    bake.image.is_unlit = of_images->is_relit;
    bake.light = of_images->light, bake.has_gloss = of_images->has_gloss;
    bake.memory_bytes = of_images->memory_bytes, bake.instructions = of_images->instructions;
    return bake;
}

Result<wang_ldi::SceneMade> add_scene(container::Writer& writer, const GroundDone& ground, const ImageArgs& images,
                                      const wang_ldi::SceneBake& bake, const command::Common& common) {
    wang_ldi::TrimReport leaves;
    auto models = read_models(ground, images, leaves);
    if (!models) return tl::unexpected(models.error());
    command::Progress progress(common, "sampling");
    auto made = wang_ldi::bake_scene(ground.ground, *models, bake, [&](double share) { progress.set(share); });
    if (!made) return made;
    auto written = wang_ldi::write_scene(writer, made->scene, uint32_t(ground.ground.set.tiles.size()));
    if (!written) return tl::unexpected(written.error());
    return made;
}

void add_scene_options_in_words(const SceneArgs& args, const ImageArgs& images, const wang_ldi::PerspectiveView& view,
                                container::Provenance& provenance) {
    auto add = [&](const char* name, const std::string& value) { provenance.options.emplace_back(name, value); };
    add("scene",
        fmt::format("{} tiles a side, {} pixels, {} to {} m, camera {},{},{},{},{},{}", args.side_tiles, args.size, args.near_m,
                    args.far_m > 0 ? fmt::format("{}", args.far_m) : "all", view.position_m.x, view.position_m.y, view.position_m.z,
                    view.heading_deg, view.pitch_deg, view.fov_y_deg));
    add("scene-eyes",
        fmt::format("{} within {} m, layers {}, merged within {}", args.eyes, args.cell_m, args.layers, args.merge_share));
    add("scene-views", fmt::format("{}", args.directions));
    add_light_options_in_words(images, provenance);
}

std::string scene_json(const wang_ldi::SceneMade& made, uint64_t stored_bytes) {
    const wang_ldi::PerspectiveLdi& image = made.scene.image;
    nlohmann::ordered_json json{{"tiles_a_side", made.scene.columns},
                                {"objects", made.objects},
                                {"size_px", {image.view.width_px, image.view.height_px}},
                                {"near_m", image.view.near_m},
                                {"far_m", image.view.far_m},
                                {"cell_m", image.cell_m},
                                {"samples", image.sample_count()},
                                {"most_layers", most_layers(image)},
                                {"bytes", stored_bytes},
                                {"rays", made.image.rays},
                                {"hits", made.image.hits},
                                {"unseen_share", image.unseen_share},
                                {"pictures", made.scene.pictures.size()},
                                {"image_s", made.image_s},
                                {"pictures_s", made.pictures_s}};
    return json.dump();
}

void say_scene(const wang_ldi::SceneMade& made, uint64_t stored_bytes, const command::Common& common) {
    const wang_ldi::PerspectiveLdi& image = made.scene.image;
    command::note(
        common,
        fmt::format("one image of {} objects on {} x {} tiles: {} samples in up to {} layers, {:.2f} bytes each; {} rays, "
                    "{:.2f} % unseen, {:.1f} s",
                    with_commas(made.objects), made.scene.columns, made.scene.rows, with_commas(image.sample_count()),
                    most_layers(image), double(stored_bytes) / std::max(1u, image.sample_count()),
                    with_commas(made.image.rays), 100 * double(image.unseen_share), made.image_s));
    command::note(common, fmt::format("{} pictures by rays, {:.1f} s", made.scene.pictures.size(), made.pictures_s));
}

}  // namespace overlook::bake_wang_ldi
