// What measure is asked to do, from its command line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/result.h"
#include "runtime/command/command.h"
#include "tools/measure/method.h"
#include "tools/measure/run.h"
#include "tools/measure/world.h"

namespace overlook::measure {

struct Options {
    std::string scene, flight;
    std::vector<std::string> cameras;
    std::string size = "512x512";
    std::vector<std::string> methods, sweeps;
    uint32_t frames = 0;  // 0 = as many as the flight has at the logical step
    bool wall_clock = false;
    std::string numbers = "all";  // all, pairs or none: Compared
    std::string out;
};

void add_options(CLI::App& app, Options& options);

// "WIDTHxHEIGHT", each 1..8192. Fails with Exit::bad_command.
Result<void> parse_size(std::string_view text, uint32_t& width_px, uint32_t& height_px);

// Of one of --numbers's words.
Compared compared_from(const Options& options);

// A camera for every frame.
struct Route {
    std::string name, content_hash;
    std::vector<view::Camera> cameras;
    double step_s = 1.0 / 60;
};

// The flight that the options name, at their size. Fails with Exit::bad_command and Exit::bad_input.
Result<Route> route_from(const Options& options, const World& world);

}  // namespace overlook::measure
