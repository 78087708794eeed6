// How long refining takes: four cameras on one thread and on all, one camera against the memory's bandwidth.
#pragma once

#include <cstdint>
#include <functional>

#include "tools/measure/paper/caveclod/fly.h"

namespace overlook::measure::paper::cameras {

// Sums over all frames of the flight's clips, of each frame the least of kSpeedRepeats runs; what is held against each other took
// turns frame by frame.
constexpr int kSpeedRepeats = 5;
struct Speed {
    unsigned threads = 1;                       // of `parallel`
    double single_ms = 0, parallel_ms = 0;      // four cameras refined on one thread, and on all
    bool is_same = true;                        // all their index buffers, to the byte, in every frame
    double own_ms = 0, printed_ms = 0;          // camera A alone on the whole screen, Overlook's form and as printed
    double own_faces = 0, printed_faces = 0;    // active, summed over frames
    double own_bytes = 0;                       // touched at least
    double bandwidth_gb_s = 0;                  // of all threads, 10^9 bytes a second

    double gain() const { return single_ms / parallel_ms; }
    double own_ns() const { return 1e6 * own_ms / own_faces; }
    double printed_ns() const { return 1e6 * printed_ms / printed_faces; }
    double own_gb_s() const { return own_bytes / (own_ms * 1e6); }
    double bytes_a_face() const { return own_bytes / own_faces; }
};

// Sets the number of threads to 1 and back to what it was. done: told the share of work done, 0..1.
Speed measure_speed(const Subject& subject, const Flying& flying, const std::function<void(double)>& done);

// What one frame of one camera reads and writes at least: a bit of each split, the bounds of each split evaluated, six faces of
// each operation.
double least_bytes(const CameraRecord& camera, uint64_t split_count);

}  // namespace overlook::measure::paper::cameras
