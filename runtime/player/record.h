// Flights recorded by hand.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "formats/scene.h"
#include "runtime/view/camera.h"

namespace overlook::player {

// How far the path between a recording's keys may be from where the camera was, at any recorded frame.
constexpr double kRecordTolerance_m = 0.05;
constexpr double kRecordTolerance_deg = 0.02;

struct Recording {
    double begin_s = 0;
    std::vector<scene::Key> samples;  // one a frame
};

// A camera as a flight's key; the heading within -180..180.
scene::Key key_of(const view::Camera& camera, double time_s);

// Adds where the camera is now; a frame at the time of the one before is left out. False if the recording is as long as a flight
// can be.
bool add_sample(Recording& recording, const view::Camera& camera, double now_s);

// A smooth flight with as few of the samples for keys as halving where it is worst gives, which at every sample's time is within
// the tolerances of the sample. samples: at least one, times growing. Cost O(n k) at most for k keys.
scene::Flight thinned(std::span<const scene::Key> samples, double tolerance_m, double tolerance_deg);

// Writes a recording, thinned, to `path`, or if that is empty to the first of flight-000.json .. flight-999.json that is free.
// Returns where. Fails with Exit::cannot_write, or Exit::impossible where the camera was farther away than a flight can say.
Result<std::string> write_recording(const Recording& recording, const std::string& path);

}  // namespace overlook::player
