#include "tools/measure/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "formats/mapped_file.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kMostPixelsASide = 8192;
constexpr uint32_t kMostFrames = 100'000;
constexpr uint32_t kFramesByKeys = 600;

bool parse_side(std::string_view text, uint32_t& side_px) {
    auto [after, problem] = std::from_chars(text.data(), text.data() + text.size(), side_px);
    return problem == std::errc() && after == text.data() + text.size() && side_px >= 1 && side_px <= kMostPixelsASide;
}

// Evenly between two keys, the heading the shorter way round.
view::Camera between(const view::Camera& a, const view::Camera& b, double t) {
    view::Camera camera = a;
    camera.position_m = a.position_m + t * (b.position_m - a.position_m);
    camera.heading_deg = a.heading_deg + t * std::remainder(b.heading_deg - a.heading_deg, 360.0);
    camera.pitch_deg = a.pitch_deg + t * (b.pitch_deg - a.pitch_deg);
    camera.fov_y_deg = a.fov_y_deg + t * (b.fov_y_deg - a.fov_y_deg);
    return camera;
}

Result<Route> route_by_keys(const Options& options) {
    std::vector<view::Camera> keys;
    std::string all;
    for (const std::string& text : options.cameras) {
        Result<view::Camera> key = view::parse_camera(text);
        if (!key) return tl::unexpected(key.error());
        keys.push_back(*key);
        all += text + "\n";
    }
    Route route;
    route.name = "keys of the command line";
    route.content_hash = content_hash(std::as_bytes(std::span(all)));
    uint32_t count = options.frames != 0 ? options.frames : kFramesByKeys;
    for (uint32_t frame = 0; frame < count; ++frame) {
        double place = count == 1 ? 0 : double(frame) / (count - 1) * double(keys.size() - 1);
        size_t first = std::min(size_t(place), keys.size() - 1), second = std::min(first + 1, keys.size() - 1);
        route.cameras.push_back(between(keys[first], keys[second], place - double(first)));
    }
    return route;
}

}  // namespace

void add_options(CLI::App& app, Options& options) {
    app.add_option("scene", options.scene, "What is flown over: a baked terrain")->required()->type_name("SCENE");
    app.add_option("--camera", options.cameras,
                   "x,y,z,heading,pitch[,fov] in metres and degrees; several are flown through evenly, in place of a flight")
        ->type_name("X,Y,Z,H,P")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--size", options.size, "Size of the pictures in pixels")->type_name("WxH")->capture_default_str();
    app.add_option("--method", options.methods,
                   "NAME[:variant][@setting=value]...: terrain (settings error-px, samples) or full (samples); may be repeated")
        ->type_name("METHOD")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--sweep", options.sweeps, "setting=value,value,...: one run a value of every method that has the setting")
        ->type_name("SWEEP")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--frames", options.frames, "Frames to measure, spread over the whole flight")->type_name("N");
    app.add_flag("--wall-clock", options.wall_clock, "Fly by the wall clock: frame times and counters only");
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

Result<Route> route_from(const Options& options, const World& world) {
    uint32_t width_px = 0, height_px = 0;
    if (Result<void> size = parse_size(options.size, width_px, height_px); !size) return tl::unexpected(size.error());
    if (options.frames > kMostFrames) return bad_command("--frames {}: at most {} are wanted", options.frames, kMostFrames);
    if (options.cameras.empty()) return bad_command("a flight is wanted: --camera x,y,z,heading,pitch, twice or more");
    Result<Route> route = route_by_keys(options);
    if (!route) return route;
    for (view::Camera& camera : route->cameras) {
        camera.width_px = width_px;
        camera.height_px = height_px;
        camera.near_m = world.near_m;
    }
    return route;
}

}  // namespace overlook::measure
