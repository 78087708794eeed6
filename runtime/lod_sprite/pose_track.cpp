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

constexpr double kJump = 8;           // times the way or turn of the frames before
constexpr double kJumpTurn_deg = 20;  // no less is a jump

}  // namespace

bool PoseTrack::add(const view::Camera& camera) {
    bool has_jumped = false;
    if (steps() > 0) {
        double step_m = glm::length(camera.position_m - newest().position_m);
        double turn_deg = std::abs(turned_deg(newest().heading_deg, camera.heading_deg));
        has_jumped = step_m > kJump * speed_m() || turn_deg > std::max(kJumpTurn_deg, kJump * turning_deg());
        if (has_jumped) forget();
    }
    latest_[count_ % kKept] = camera;
    ++count_;
    return has_jumped;
}

size_t PoseTrack::steps() const {
    return count_ > 0 ? std::min(count_, kKept) - 1 : 0;
}

view::Camera PoseTrack::predicted(double frames) const {
    assert(count_ > 0);
    const view::Camera &last = newest(), &first = oldest();
    if (steps() == 0) return last;
    double share = frames / double(steps());
    view::Camera camera = last;
    camera.position_m += share * (last.position_m - first.position_m);
    camera.heading_deg += share * turned_deg(first.heading_deg, last.heading_deg);
    camera.pitch_deg = std::clamp(last.pitch_deg + share * (last.pitch_deg - first.pitch_deg), -90.0, 90.0);
    return camera;
}

double PoseTrack::speed_m() const {
    return steps() > 0 ? glm::length(newest().position_m - oldest().position_m) / double(steps()) : 0;
}

double PoseTrack::turning_deg() const {
    return steps() > 0 ? std::abs(turned_deg(oldest().heading_deg, newest().heading_deg)) / double(steps()) : 0;
}

}  // namespace overlook::lod_sprite
