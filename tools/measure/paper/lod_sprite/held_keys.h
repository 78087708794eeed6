// Ghosts and losses against parallax: keys held far longer than their methods would, so that all parallaxes are there.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/measure/charts.h"
#include "tools/measure/numbers/parallax.h"
#include "tools/measure/paper/lod_sprite/fly.h"
#include "tools/measure/reuse_truth.h"

namespace overlook::measure::paper::sprite {

// What measuring.md's prototype of the paper had of the pixels "at moderate parallax", and what is to be reached up to 32 px.
struct HeldGoals {
    static constexpr double kEdge_px = 32;
    static constexpr double kPrototypeGhosts = 0.013, kPrototypeLosses = 0.128;
    static constexpr double kGhosts = 0.002, kLosses = 0.015;
};

constexpr double kHeldThreshold_px = 1000;  // of keys that are held

// One method with held keys.
struct HeldRun {
    MethodSpec spec;
    std::string title;  // "paper: depth thickness 1e-5"; no commas
    ParallaxTally tally;
    uint32_t judged_frames = 0;  // of those that used a key
};

// Both forms with their keys' threshold out of reach: Overlook's; the paper's with its
// depth-thickness, for which it prints no value, swept; with strips.
std::vector<HeldRun> held_runs(const Plan& plan);

// Flies some parts of the flight's 600 frames, evenly spread, kHeldFrames each; every method begins each anew, so that all hold a
// key of the part's beginning. Every kHeldStep-th frame is judged. Fails with Exit::impossible (targets).
constexpr uint32_t kHeldFrames = 60, kHeldStep = 6;
Result<std::vector<HeldRun>> fly_held_keys(const Flying& flying, const Plan& plan, uint32_t parts,
                                           const std::function<void(double)>& done);

// What each pixel of a frame was, and its parallax: against the key that it shows, of several the greatest; where it shows none,
// the least of those in use (there must be one). reuse: of the same sources and frame.
struct JudgedPixels {
    std::vector<float> parallax_px;  // [height, width], as measure::parallax_px
    std::vector<Reused> pixels;
};
JudgedPixels judged_pixels(const Sources& sources, const Frame& truth, const Reuse& reuse);

// held_keys.csv: a row a run and range of parallax.
std::string held_keys_csv(const std::vector<HeldRun>& runs);
// charts/ghosts-parallax and charts/losses-parallax, from that table.
std::vector<Chart> held_keys_charts(const std::vector<HeldRun>& runs);

}  // namespace overlook::measure::paper::sprite
