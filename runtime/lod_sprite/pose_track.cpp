#include "runtime/lod_sprite/pose_track.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace overlook::lod_sprite {
namespace {

// The shorter way round, -180..180.
double turned_deg(double from_deg, double to_deg) {
    return std::remainder(to_deg - from_deg, 360.0);
}

}  // namespace

void PoseTrack::add(const view::Camera& camera) {
    latest_[count_ % kKept] = camera;
    ++count_;
}

view::Camera PoseTrack::predicted(double frames) const {
    assert(count_ > 0);
    const view::Camera& last = latest_[(count_ - 1) % kKept];
    size_t steps = std::min(count_, kKept) - 1;
    if (steps == 0) return last;
    const view::Camera& first = latest_[(count_ - 1 - steps) % kKept];
    double share = frames / double(steps);
    view::Camera camera = last;
    camera.position_m += share * (last.position_m - first.position_m);
    camera.heading_deg += share * turned_deg(first.heading_deg, last.heading_deg);
    camera.pitch_deg = std::clamp(last.pitch_deg + share * (last.pitch_deg - first.pitch_deg), -90.0, 90.0);
    return camera;
}

double PoseTrack::speed_m() const {
    size_t steps = std::min(count_, kKept);
    if (steps < 2) return 0;
    const view::Camera &last = latest_[(count_ - 1) % kKept], &first = latest_[(count_ - steps) % kKept];
    return glm::length(last.position_m - first.position_m) / double(steps - 1);
}

}  // namespace overlook::lod_sprite
