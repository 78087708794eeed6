// Where the camera is going, from where it has been.
#pragma once

#include <array>
#include <cstddef>

#include "runtime/view/camera.h"

namespace overlook::lod_sprite {

// The past few viewpoints of a camera, one a frame.
class PoseTrack {
  public:
    void add(const view::Camera& camera);
    void forget() { count_ = 0; }
    // The last camera, `frames` further along: its place and angles go on as fast as they did on the average over the last four
    // frames. frames may be a fraction. add() must have been called.
    view::Camera predicted(double frames) const;
    // Metres a frame, on the same average.
    double speed_m() const;

  private:
    static constexpr size_t kKept = 5;
    std::array<view::Camera, kKept> latest_{};  // the newest at (count_ - 1) % kKept
    size_t count_ = 0;
};

}  // namespace overlook::lod_sprite
