#include "runtime/player/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "runtime/player/record.h"

namespace overlook::player {
namespace {

constexpr uint32_t kMostPixelsASide = 32768;
constexpr double kMostError_px = 10000;
constexpr double kFarthest_m = 1e9;
constexpr uint32_t kMostFrames = 10'000'000;
constexpr uint32_t kMostLatency_frames = 1000;

bool parse_side(std::string_view text, uint32_t& side_px) {
    auto [after, problem] = std::from_chars(text.data(), text.data() + text.size(), side_px);
    return problem == std::errc() && after == text.data() + text.size() && side_px >= 1 && side_px <= kMostPixelsASide;
}

Result<void> check_numbers(const Options& options) {
    if (!(options.error_px > 0 && options.error_px <= kMostError_px)) {
        return bad_command("--error-px {}: a number of pixels above 0 and up to {} is wanted", options.error_px, kMostError_px);
    }
    if (!(options.frame_ms >= 0 && options.frame_ms <= 1e6)) {
        return bad_command("--frame-ms {}: a number of milliseconds up to 1000000 is wanted (0 = no budget)", options.frame_ms);
    }
    if (!(options.morph >= 0 && options.morph <= 10)) {
        return bad_command("--morph {}: a number from 0 (pop) to 10 is wanted", options.morph);
    }
    if (!(options.haze >= 0 && options.haze <= 10)) {
        return bad_command("--haze {}: a number from 0 (clear) to 10 is wanted; 1 is a fair day", options.haze);
    }
    if (options.samples != 0 && options.samples != 1 && options.samples != 2 && options.samples != 4 && options.samples != 8) {
        return bad_command("--samples {}: 1, 2, 4 or 8 samples a pixel are wanted (0 = chosen)", options.samples);
    }
    if (options.frames > kMostFrames) return bad_command("--frames {}: at most {} are wanted", options.frames, kMostFrames);
    if (options.sets_upload_budget && options.stream_memory_bytes == 0) {
        return bad_command("--upload-budget: is of what is streamed; give --stream-memory as well");
    }
    if (options.stream_latency > 0 && options.stream_memory_bytes == 0) {
        return bad_command("--stream-latency: is of what is streamed; give --stream-memory as well");
    }
    if (options.stream_latency > kMostLatency_frames) {
        return bad_command("--stream-latency {}: at most {} frames are wanted", options.stream_latency, kMostLatency_frames);
    }
    if (!options.flight.empty() && !options.cameras.empty()) return bad_command("--flight and --camera exclude each other");
    if (options.wireframe && options.split_picture) {
        return bad_command("--wireframe and --split-picture exclude each other");
    }
    return {};
}

// Where "%04d" stands in a name.
struct NumberPlace {
    size_t begin = std::string::npos, length = 0;
    int digits = 0;
};

// False if a % begins anything else.
bool find_number(const std::string& pattern, NumberPlace& place) {
    place.begin = pattern.find('%');
    if (place.begin == std::string::npos) return true;
    size_t i = place.begin + 1;
    for (; i < pattern.size() && pattern[i] >= '0' && pattern[i] <= '9' && place.digits < 10; ++i) {
        place.digits = place.digits * 10 + (pattern[i] - '0');
    }
    place.length = i + 1 - place.begin;
    return i < pattern.size() && pattern[i] == 'd' && place.digits <= 10 && pattern.find('%', i) == std::string::npos;
}

}  // namespace

Result<void> check_fit(const Options& options, Method method, Thing thing) {
    struct Rule {
        const char* name;
        bool is_given, is_taken;
        const char* takers = "terrain does";
    };
    bool is_planting = method >= Method::wang_ldi;
    bool is_terrain = method == Method::terrain, is_triangles = has_wireframe(method);
    const Rule kRules[] = {{"--triangles", options.triangles > 0, takes_budgets(method)},
                           {"--frame-ms", options.frame_ms > 0, takes_budgets(method)},
                           {"--morph", options.sets_morph, is_terrain},
                           {"--stream-memory", options.stream_memory_bytes > 0,
                            is_terrain || method == Method::caveclod || is_planting, "terrain, caveclod and wang-ldi do"},
                           {"--wireframe", options.wireframe, is_triangles},
                           {"--split-picture", options.split_picture, is_terrain},
                           {"--pipelined", options.pipelined, is_planting, "wang-ldi does"},
                           {"--rings", options.rings, is_planting, "wang-ldi does"},
                           {"--haze", options.sets_haze, thing == Thing::terrain || is_planting}};
    for (const Rule& rule : kRules) {
        if (rule.is_given && !rule.is_taken)
            return bad_command("{}: {} does not take it; --method {}", rule.name, name_of(method), rule.takers);
    }
    return {};
}

Result<void> check_kind(const Options& options, Method method, Thing thing) {
    if (draws(method, thing)) return {};
    Method first = default_method(thing);
    std::string fitting(name_of(first));
    for (Method one = next(first, thing); one != first; one = next(one, thing)) fitting += fmt::format(", {}", name_of(one));
    return bad_command("--method {}: it draws {}, and {} holds a {}; that takes {}", name_of(method), things_of(method),
                       options.file, name_of(thing), fitting);
}

void choose_samples(Plan& plan, bool is_software, bool is_window) {
    if (plan.options.samples == 0) plan.options.samples = is_software && is_window ? 1 : 4;
    // Software draws anisotropic texels four to eight times as slowly, and Mesa 22.3's llvmpipe has been seen to stop at them
    // altogether.
    plan.draw.anisotropy = is_software ? 1.0f : 8.0f;
}

void add_options(CLI::App& app, Options& options) {
    app.add_option("file", options.file, "A baked terrain, mesh, chain of levels or planting, or a scene of one")
        ->required()
        ->type_name("FILE.ovl|SCENE.json");
    app.add_flag("--headless", options.headless, "Draw without a window");
    app.add_option("--size", options.size, "Size of the picture in pixels")->type_name("WxH")->capture_default_str();
    app.add_option("--camera", options.cameras,
                   "x,y,z,heading,pitch[,fov] in metres and degrees (z up, heading from north); several are flown through")
        ->type_name("X,Y,Z,H,P")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--flight", options.flight, "Flight to follow, frame by frame at its own step; then end")
        ->type_name("FLIGHT.json");
    app.add_option("--record", options.record, "Where the key R records a flight to; default flight-000.json and so on")
        ->type_name("FLIGHT.json");
    app.add_option("--frames", options.frames, "Frames to draw; then end. Of a flight at most these")->type_name("N");
    app.add_option("--image", options.image, "Picture to write: the last frame, or every frame with a number such as %04d")
        ->type_name("FILE.png");
    app.add_option("--method", options.method,
                   "What to draw with: a terrain by terrain, lod-sprite or lod-sprite:paper, a mesh by caveclod, caveclod:paper, "
                   "caveclod:shared, discrete or lod-sprite, a chain of levels by discrete, discrete:fsi-paper, discrete:switch, "
                   "discrete:blend, discrete:dither or discrete:late, a planting by wang-ldi or wang-ldi:paper (layered depth "
                   "images for all "
                   "tiles, the nearest too); default what the scene says, or the first. In the window M changes it, K shows what "
                   "lod-sprite "
                   "takes from where, and wang-ldi's levels and directions")
        ->type_name("NAME");
    CLI::Option* triangles = app.add_option("--triangles", options.triangles,
                                            "Triangles a frame at most, of a planting its ground's and those of plants drawn as "
                                            "geometry: the error rises above --error-px where it must")
                                 ->type_name("N");
    app.add_option("--frame-ms", options.frame_ms, "Milliseconds a frame at most, likewise")
        ->type_name("MS")
        ->excludes(triangles);
    app.add_option(
           "--morph", options.morph,
           "Vertices glide to their place as their error grows from 1/(1 + this) of the error asked to all of it; 0 = they pop")
        ->capture_default_str()
        ->each([&options](const std::string&) { options.sets_morph = true; });
    app.add_option("--error-px", options.error_px, "Nothing in the picture is displaced by more than this")
        ->type_name("PIXELS")
        ->capture_default_str()
        ->each([&options](const std::string&) { options.sets_error_px = true; });
    app.add_flag("--wireframe", options.wireframe, "Draw the triangles' edges");
    app.add_flag("--rings", options.rings, "Show a planting's levels and directions by colours");
    app.add_flag("--pipelined", options.pipelined,
                 "Warp a planting's next picture while this one is drawn: more pictures, each a frame late");
    app.add_flag("--split-picture", options.split_picture, "Left half wireframe, right half shaded");
    app.add_option("--haze", options.haze, "How hazy the air is: 0 = clear, 1 = a fair day")
        ->capture_default_str()
        ->each([&options](const std::string&) { options.sets_haze = true; });
    app.add_option("--samples", options.samples,
                   "Samples a pixel: 1 (fast), 2, 4 or 8 (smooth); default 4, or 1 in a window drawn by software");
    command::add_bytes_option(
        app, "--stream-memory", options.stream_memory_bytes,
        "Keep at most so much of the terrain, the mesh or a planting's images in memory and read the rest as it is needed: "
        "bytes, "
        "or with K, M, G; of a terrain, one baked with --streamed. Where it is too little the picture is coarser, and says so");
    command::add_bytes_option(app, "--upload-budget", options.upload_budget_bytes,
                              "Of what is streamed, take over at most so much in a frame; default 16M")
        ->each([&options](const std::string&) { options.sets_upload_budget = true; });
    app.add_option("--stream-latency", options.stream_latency,
                   "Without a window: what is streamed comes so many frames after it is asked for, and no picture waits; "
                   "default: every picture waits for all that memory has room for")
        ->type_name("FRAMES");
    app.add_option("--report", options.report, "Write counts, times and predicted errors of every frame")->type_name("FILE.json");
}

Result<void> parse_size(std::string_view text, uint32_t& width_px, uint32_t& height_px) {
    size_t cross = text.find('x');
    if (cross == std::string_view::npos || !parse_side(text.substr(0, cross), width_px) ||
        !parse_side(text.substr(cross + 1), height_px)) {
        return bad_command("--size {}: WIDTHxHEIGHT is wanted, each from 1 to {}", text, kMostPixelsASide);
    }
    return {};
}

bool is_numbered(const std::string& pattern) {
    return pattern.find('%') != std::string::npos;
}

Result<std::string> image_path(const std::string& pattern, uint32_t frame) {
    NumberPlace place;
    if (!find_number(pattern, place)) {
        return bad_command("--image {}: a % begins the frame's number, such as %04d, and stands only once", pattern);
    }
    if (place.begin == std::string::npos) return pattern;
    std::string path = pattern;
    return path.replace(place.begin, place.length, fmt::format("{:0{}}", frame, place.digits));
}

Result<Plan> plan_from(const Options& options) {
    if (Result<void> checked = check_numbers(options); !checked) return tl::unexpected(checked.error());
    Plan plan;
    plan.options = options;
    plan.flight.interpolation = scene::Interpolation::linear;
    if (Result<void> size = parse_size(options.size, plan.width_px, plan.height_px); !size) return tl::unexpected(size.error());
    if (Result<std::string> path = image_path(options.image, 0); !path) return tl::unexpected(path.error());

    if (!options.method.empty()) {
        Result<Method> method = parse_method(options.method);
        if (!method) return tl::unexpected(method.error());
        Thing thing = draws(*method, Thing::terrain) ? Thing::terrain
                      : draws(*method, Thing::mesh)  ? Thing::mesh
                      : draws(*method, Thing::chain) ? Thing::chain
                                                     : Thing::planting;  // till the file is read
        if (Result<void> fit = check_fit(options, *method, thing); !fit) return tl::unexpected(fit.error());
        plan.method = *method;
    }
    for (const std::string& text : options.cameras) {
        Result<view::Camera> camera = view::parse_camera(text);
        if (!camera) return tl::unexpected(camera.error());
        const glm::dvec3& at_m = camera->position_m;
        if (std::abs(at_m.x) > kFarthest_m || std::abs(at_m.y) > kFarthest_m || std::abs(at_m.z) > kFarthest_m ||
            std::abs(camera->heading_deg) > kFarthest_m) {
            return bad_command("--camera {}: a number is beyond {}", text, kFarthest_m);
        }
        plan.flight.keys.push_back(key_of(*camera, double(plan.flight.keys.size())));
    }
    if (!options.flight.empty()) {
        Result<scene::Flight> flight = scene::read_flight(options.flight);
        if (!flight) return tl::unexpected(flight.error());
        plan.flight = std::move(*flight);
    }
    if (options.wireframe) plan.draw.look = terrain::Look::wireframe;
    if (options.split_picture) plan.draw.look = terrain::Look::split;
    plan.draw.haze = options.haze;
    plan.base.width_px = plan.width_px;
    plan.base.height_px = plan.height_px;
    return plan;
}

}  // namespace overlook::player
