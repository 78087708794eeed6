#include "tools/measure/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "formats/mapped_file.h"
#include "formats/scene.h"
#include "runtime/terrain/near_plane.h"
#include "runtime/view/flight.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kMostPixelsASide = 8192;
constexpr uint32_t kMostFrames = 100'000;
constexpr uint32_t kFramesByKeys = 600;

bool parse_side(std::string_view text, uint32_t& side_px) {
    auto [after, problem] = std::from_chars(text.data(), text.data() + text.size(), side_px);
    return problem == std::errc() && after == text.data() + text.size() && side_px >= 1 && side_px <= kMostPixelsASide;
}

// The keys of the command line, equally far apart, with everything changing evenly between them.
Result<scene::Flight> flight_by_keys(const Options& options, Route& route) {
    scene::Flight flight;
    flight.interpolation = scene::Interpolation::linear;
    std::string all;
    uint32_t frames = options.frames != 0 ? options.frames : kFramesByKeys;
    double between_keys_s = options.cameras.size() > 1 ? flight.step_s * (frames - 1) / double(options.cameras.size() - 1) : 0;
    for (const std::string& text : options.cameras) {
        Result<view::Camera> key = view::parse_camera(text);
        if (!key) return tl::unexpected(key.error());
        double time_s = between_keys_s * double(flight.keys.size());
        const glm::dvec3& at_m = key->position_m;
        flight.keys.push_back({time_s, {at_m.x, at_m.y, at_m.z}, key->heading_deg, key->pitch_deg, key->fov_y_deg});
        all += text + "\n";
    }
    route.name = "keys of the command line";
    route.content_hash = content_hash(std::as_bytes(std::span(all)));
    route.step_s = flight.step_s;
    return flight;
}

Result<scene::Flight> flight_from_file(const Options& options, Route& route) {
    Result<scene::Flight> flight = scene::read_flight(options.flight);
    Result<MappedFile> file = MappedFile::open(options.flight);
    if (!flight) return flight;
    if (!file) return tl::unexpected(file.error());
    route.name = options.flight.substr(options.flight.rfind('/') + 1);
    route.content_hash = content_hash(file->bytes());
    route.step_s = flight->step_s;
    // Fewer or more frames than the flight has are spread over all of it.
    double length_s = flight->keys.back().time_s;
    if (options.frames > 1) route.step_s = length_s / (options.frames - 1);
    return flight;
}

}  // namespace

void add_options(CLI::App& app, Options& options) {
    app.add_option("scene", options.scene, "What is flown over: a scene (.json), or a baked terrain or mesh by itself (.ovl)")
        ->required()
        ->type_name("SCENE");
    app.add_option("--flight", options.flight, "The flight")->type_name("FLIGHT.json");
    app.add_option("--camera", options.cameras,
                   "x,y,z,heading,pitch[,fov] in metres and degrees; several are flown through evenly, in place of a flight")
        ->type_name("X,Y,Z,H,P")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--size", options.size, "Size of the pictures in pixels")->type_name("WxH")->capture_default_str();
    app.add_option(
           "--method", options.methods,
           "NAME[:variant][@setting=value]..., may be repeated: terrain (settings error-px, samples, triangles, morph); "
           "terrain:hard, whose levels pop (error-px, samples, triangles); lod-sprite (error-px of keys, low-error-px, "
           "key-error-px, samples, keyframe=at-once|thread|sliced: how keys are made; and its remedies, each to be switched "
           "off); lod-sprite:paper, as published (error-px, "
           "low-error-px, key-error-px, depth-thickness, eye-depth, strips, samples); of meshes: lod-sprite as well; caveclod "
           "(error-px, samples, triangles, "
           "operations, cameras that refine at once, glide-s, silhouette-px and others); caveclod:paper, as published, and "
           "caveclod:shared, one refinement for all cameras (error-px, cameras, samples); discrete, levels for the whole mesh "
           "(error-px, samples); of chains of levels: discrete or discrete:fsi, by turns (error-px, "
           "by=error|size|distance|importance, "
           "fade-s, samples; and its remedies, each to be switched off), discrete:fsi-paper, as published, discrete:switch, "
           "discrete:blend, discrete:dither and discrete:late; of all: full (samples)")
        ->type_name("METHOD")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--sweep", options.sweeps, "setting=value,value,...: one run a value of every method that has the setting")
        ->type_name("SWEEP")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--frames", options.frames,
                   "Frames to measure, spread over the whole flight; default as many as it has, 600 between keys")
        ->type_name("N");
    app.add_option("--numbers", options.numbers,
                   "Which frames are held against the reference: all; pairs (every tenth and the one after it, and those round "
                   "events); none (times and counters only)")
        ->check(CLI::IsMember({"all", "pairs", "none"}))
        ->type_name("WHICH")
        ->capture_default_str();
    app.add_flag("--wall-clock", options.wall_clock, "Fly by the wall clock: frame times and counters only")
        ->excludes("--numbers");
    app.add_option("--out", options.out, "Folder for the tables, charts and the page; made if it is not there")
        ->type_name("DIR")
        ->required();
}

Result<void> parse_size(std::string_view text, uint32_t& width_px, uint32_t& height_px) {
    size_t cross = text.find('x');
    if (cross == std::string_view::npos || !parse_side(text.substr(0, cross), width_px) ||
        !parse_side(text.substr(cross + 1), height_px)) {
        return bad_command("--size {}: WIDTHxHEIGHT is wanted, each from 1 to {}", text, kMostPixelsASide);
    }
    return {};
}

Compared compared_from(const Options& options) {
    if (options.wall_clock || options.numbers == "none") return Compared::none;
    return options.numbers == "pairs" ? Compared::pairs : Compared::all;
}

Result<Route> route_from(const Options& options, const World& world) {
    uint32_t width_px = 0, height_px = 0;
    if (Result<void> size = parse_size(options.size, width_px, height_px); !size) return tl::unexpected(size.error());
    if (options.frames > kMostFrames) return bad_command("--frames {}: at most {} are wanted", options.frames, kMostFrames);
    if (options.flight.empty() == options.cameras.empty()) {
        return bad_command("either --flight FLIGHT.json or --camera x,y,z,heading,pitch (twice or more) is wanted");
    }
    Route route;
    Result<scene::Flight> flight = options.flight.empty() ? flight_by_keys(options, route) : flight_from_file(options, route);
    if (!flight) return tl::unexpected(flight.error());
    uint32_t count = options.frames != 0 ? options.frames : options.flight.empty() ? kFramesByKeys : scene::frame_count(*flight);
    if (count > kMostFrames) {
        return bad_command("{} has {} frames; give --frames, at most {}", options.flight, count, kMostFrames);
    }
    view::Camera base = world.base;
    base.width_px = width_px;
    base.height_px = height_px;
    for (uint32_t frame = 0; frame < count; ++frame) {
        view::Camera camera = view::camera_at(*flight, frame * route.step_s, base);
        route.cameras.push_back(world.local(camera));
    }
    return route;
}

}  // namespace overlook::measure
