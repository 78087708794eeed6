// Flyovers with one to four cameras, without drawing: what refining does, counted.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/measure/paper/caveclod/team.h"

namespace overlook::measure::paper::cameras {

// How all of a run is flown.
struct Flying {
    uint32_t width_px = 800, height_px = 600;
    uint32_t frames = 600;        // of the flights'; the clips that they make are those of clips_of()
    uint32_t stride = 1;          // every so-manieth frame of the flights alone: a slower machine
    caveclod::Settings settings;  // error_px, and what else a camera asks for
};

// Of the frames that are flown: how many there are of a flight, from one to the next, which clips of them.
uint32_t frame_count(const Subject& subject, const Flying& flying);
double step_s(const Subject& subject, const Flying& flying);
std::vector<Clip> clips_of(const Subject& subject, const Flying& flying);
// All of `count` cameras in their places at a frame.
std::vector<view::Camera> cameras_at(const Subject& subject, const Flying& flying, uint32_t count, uint32_t frame);

struct CameraRecord {
    uint32_t split_count = 0, collapse_count = 0, evaluated_count = 0;
    uint64_t face_count = 0;
    CameraMemory memory;
};
struct FlownFrame {
    uint32_t frame = 0;  // of those that are flown
    std::vector<CameraRecord> cameras;
    std::optional<double> used_share;  // of all render vertices, by the cameras together: on every kCoverageStep-th frame
};
constexpr uint32_t kCoverageStep = 10;

struct Flyover {
    Way way = Way::own;
    uint32_t cameras = 1;
    double step_s = 0;
    std::vector<Clip> clips;
    std::vector<FlownFrame> frames;  // of all clips, one after the other
};

// Every clip that does not go on from the one before is begun kLeadFrames earlier, with everything settled: what a flight that is
// under way knows; at the flight's beginning the cameras stand there as long. Those frames are not counted.
constexpr uint32_t kLeadFrames = 30;
Flyover fly(const Subject& subject, const Flying& flying, Way way, uint32_t cameras);

// Calls of(frame, is_counted) for every frame of the clips with what leads to them, and settle(frame) before each gap. has_memory:
// as of Team.
void over_frames(std::span<const Clip> clips, bool has_memory, const std::function<void(uint32_t frame)>& settle,
                 const std::function<void(uint32_t frame, bool is_counted)>& of);

// Splits and collapses a second of flight, of one camera in the mean.
double operations_per_s(const Flyover& flyover);
double splits_per_s(const Flyover& flyover);

// kClipFrames frames one after the other.
struct Window {
    double time_s = 0;  // its middle, of flight
    std::vector<FlownFrame> frames;
};
std::vector<Window> windows_of(const Flyover& flyover);

}  // namespace overlook::measure::paper::cameras
