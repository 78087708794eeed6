// What the player is asked to do, from its command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/result.h"
#include "formats/scene.h"
#include "runtime/command/command.h"
#include "runtime/player/method.h"
#include "runtime/terrain/draw.h"
#include "runtime/view/camera.h"

namespace overlook::player {

struct Options {
    std::string file;  // the baked terrain or mesh, or a scene of one (.json)
    bool headless = false;
    std::string size = "1280x720";
    std::vector<std::string> cameras;  // none = an overview of the whole
    std::string flight;                // a flight to follow; empty = none
    std::string record;                // where R records a flight to; empty = flight-NNN.json
    uint32_t frames = 0;               // 0 = all of the flight; without one a picture headless, endless in a window
    std::string image;                 // where pictures go; empty = nowhere
    std::string report;                // where the report goes; empty = nowhere
    double error_px = 1;
    uint64_t triangles = 0;  // budgets of a frame, 0 = none; at most one of the two
    double frame_ms = 0;
    double morph = terrain::kDefaultMorph;  // 0 = vertices pop; as Refiner::cut_by_pixels
    std::string method;                     // empty = what the scene says, or by the file's kind
    bool wireframe = false;
    bool split_picture = false;
    bool pipelined = false;  // of plantings: the next frame is warped while this one is drawn
    bool rings = false;      // of plantings: levels and directions by colours
    double haze = 1;
    bool sets_error_px = false, sets_haze = false, sets_morph = false;  // on the command line, which goes before the scene
    uint64_t stream_memory_bytes = 0;                                   // of what is read in parts; 0 = read whole
    uint64_t upload_budget_bytes = 16u << 20;                           // of what is streamed, a frame
    uint32_t stream_latency = 0;                                        // in frames, without a window; 0 = pictures wait
    bool sets_upload_budget = false;
    uint32_t samples = 0;  // a pixel; 0 = settled by choose_samples
};

// The same, understood.
struct Plan {
    Options options;
    uint32_t width_px = 0, height_px = 0;
    scene::Flight flight;  // the cameras, or --flight's; no keys = an overview, until settle() of scene.h
    view::Camera base;     // what the flight does not say
    terrain::DrawOptions draw;
    std::optional<Method> method;  // --method; else the scene's, until settle() of scene.h
};

void add_options(CLI::App& app, Options& options);

// Fails with Exit::bad_command and a line that names the option, or as scene::read_flight.
Result<Plan> plan_from(const Options& options);

// Fails with Exit::bad_command if an option asks for what the method cannot do:
//   "--triangles: lod-sprite does not take it; --method terrain does"
//   "--method caveclod: it draws meshes, and valley.ovl holds a terrain; that takes terrain, lod-sprite, lod-sprite:paper"
Result<void> check_fit(const Options& options, Method method, Thing thing);
// file_method: one that the file can be drawn with.
Result<void> check_kind(const Options& options, Method method, Thing thing);

// Settles the samples a pixel, if none were asked for: 4, but 1 in a window that the processor draws, which would else be too
// slow to fly. With 1 the texture is filtered the fast way as well.
void choose_samples(Plan& plan, bool is_software, bool is_window);

// "WIDTHxHEIGHT", each 1..32768.
Result<void> parse_size(std::string_view text, uint32_t& width_px, uint32_t& height_px);

// The file of picture `frame`: "out/%04d.png" numbers them, any other name is one file. Fails with Exit::bad_command if a %
// begins anything but one such number.
Result<std::string> image_path(const std::string& pattern, uint32_t frame);
bool is_numbered(const std::string& pattern);

}  // namespace overlook::player
