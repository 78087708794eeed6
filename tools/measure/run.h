// A run: every method over every frame of a flight, side by side, measured against the reference.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/image.h"
#include "tools/measure/method.h"
#include "tools/measure/numbers/honesty_tally.h"
#include "tools/measure/numbers/temporal.h"
#include "tools/measure/reference.h"
#include "tools/measure/world.h"

namespace overlook::measure {

// On which frames pictures are held against the reference, which is dear to draw.
enum class Compared {
    all,    // every one
    steps,  // every one, but E on every tenth alone, whatever events there are: for many runs, whose events lie everywhere
    pairs,  // every tenth with the one after it, and three round each event
    none,   // none: times and counters only
};

// What is measured.
struct Course {
    std::vector<MethodSpec> specs;      // each one once; their floors among them, if any frame is compared
    std::vector<view::Camera> cameras;  // one a frame, all of the same size
    double step_s = 1.0 / 60;           // of the logical clock, from frame to frame
    Compared compared = Compared::all;
    // Drawn by every run before the first frame, and not counted: what a flight that is under way knows.
    std::vector<view::Camera> lead = {};
};

// G is taken on at most so many frames, evenly spread from the first to the last: each looks at every sample in view.
constexpr uint32_t kMostHonestyFrames = 12;

// What a frame was beside the reference. Empty where it was not taken.
struct Numbers {
    std::optional<double> e_p99, e_mean;  // LDR-FLIP over the pixels: every tenth frame and round events
    std::optional<double> w;              // where the frame before was compared as well
    std::optional<double> s_p95_px, s_max_px;
    std::optional<double> hole_count, hole_allowed_count;  // allowed: not counted, for the error promised explains them
    std::optional<double> psnr_db, luma_difference;
    // Of methods that show pictures again, where they did: shares of the surface's pixels (reuse_truth.h).
    std::optional<double> ghost_share, loss_share, near_share;
    std::optional<Honesty> g;  // of the things drawn: on a few frames, of methods that promise something of each
};

struct FrameRecord {
    uint32_t frame = 0;
    Counters counters;
    double decide_ms = 0;
    double draw_ms = 0;  // submitting and waiting until it is drawn
    Numbers numbers;

    double frame_ms() const { return decide_ms + draw_ms; }
};

// The frame of a run that a number likes least.
struct WorstFrame {
    bool is_there = false;
    uint32_t frame = 0;
    double value = 0;
    ImageRgb8 test, reference;
    std::vector<float> map;  // [height, width] of the error, 0..1
};

struct RunResult {
    MethodSpec spec;
    std::string label;
    size_t floor = 0;  // which run is its floor: full geometry at the same samples a pixel; itself where nothing is compared
    std::vector<FrameRecord> frames;
    PopIndex pop;
    std::vector<TemporalError> temporal;  // W of every frame that has one, by tiles
    HonestyTally g;  // over all frames on which it was taken
    WorstFrame worst_e, worst_w;
};

// Where the time of a run went; of no interest but to who waits for it.
struct TimeSpent {
    double references_ms = 0, methods_ms = 0, promises_ms = 0, numbers_ms = 0;
};

struct CourseResult {
    std::vector<RunResult> runs;  // as in Course::specs
    uint64_t references_drawn = 0, references_kept = 0, references_damaged = 0;
    TimeSpent spent;
};

// Adds to specs the floor of each that has none yet.
void add_floors(std::vector<MethodSpec>& specs);

// Draws and measures on the logical clock: frame by frame, every run once each, beginning with another run every frame, so that
// a drift of the machine hits all alike. Every run is drawn once before the first frame, which does not count. Times are of the
// steady clock from deciding until everything is drawn; reading back, depth and the numbers are outside them. Keeps two frames of
// each run in memory. Without a frame to compare nothing is read back and no reference drawn. The pictures, the counters and the
// numbers are the same every time; the times are not. done: told the share of work done, 0..1. Fails with Exit::impossible
// (targets) and Exit::cannot_write (kept references).
Result<CourseResult> run_course(World& world, const Course& course, const gl::Renderer& renderer, const std::string& cache_folder,
                                const std::function<void(double)>& done);

// Flies by the wall clock instead: each run alone, the camera where the flight is at that moment, until its end. Frame times and
// counters only; which frames are drawn depends on the machine.
Result<CourseResult> run_by_wall_clock(World& world, const Course& course, const std::function<void(double)>& done);

}  // namespace overlook::measure
