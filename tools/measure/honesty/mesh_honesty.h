// G, honesty: what a refined mesh promises of a frame, against what it does.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "formats/caveclod.h"
#include "runtime/view/camera.h"
#include "tools/measure/honesty/nearest_point.h"
#include "tools/measure/numbers/honesty.h"

namespace overlook::measure {

// A frame of a mesh promises one thing: that nothing in it is displaced by more than error_px. It is held against the greatest
// displacement on the screen, both ways: of each of the source's positions in the frame to the nearest point that is drawn, and of
// each drawn triangle's middle in the frame to the nearest point of the source. (The nearest point is at most as far away as the
// bound allows any to be, so an honest bound holds for it.)
class MeshHonesty {
  public:
    explicit MeshHonesty(const caveclod::Hierarchy& hierarchy);

    // drawn_m: corners in the world, three a triangle. One thing, or none where nothing is in the frame. finest_m: what the source
    // itself may have been moved by when it was stored is not measured: the file's finest cut is the source here.
    Promises promises_of(std::span<const glm::dvec3> drawn_m, const view::Camera& camera, double error_px) const;

  private:
    std::vector<glm::dvec3> places_m_;  // the source's positions
    std::unique_ptr<NearestPoint> source_;
};

}  // namespace overlook::measure
