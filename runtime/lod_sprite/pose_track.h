// Where the camera is going, from where it has been.
#pragma once

#include <array>
#include <cstddef>

#include "runtime/view/camera.h"

namespace overlook::lod_sprite {

// The past few viewpoints of a camera, one a frame.
class PoseTrack {
  public:
    // A step or turn many times as long as those before is a jump: the track begins anew with it. Returns whether it was one.
    bool add(const view::Camera& camera);
    void forget() { count_ = 0; }
    // The last camera, `frames` further along: its place and angles go on as fast as they did on the average over the last four
    // frames. frames may be a fraction. add() must have been called.
    view::Camera predicted(double frames) const;
    // Metres and degrees of heading a frame, on the same average.
    double speed_m() const;
    double turning_deg() const;

  private:
    static constexpr size_t kKept = 5;
    std::array<view::Camera, kKept> latest_{};  // the newest at (count_ - 1) % kKept
    size_t steps() const;
    const view::Camera& newest() const { return latest_[(count_ - 1) % kKept]; }
    const view::Camera& oldest() const { return latest_[(count_ - 1 - steps()) % kKept]; }

    size_t count_ = 0;
};

}  // namespace overlook::lod_sprite
