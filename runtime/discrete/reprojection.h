// Where what a frame shows was in the frame before, for the combination of two frames.
//
// Based on: D. Scherzer, M. Wimmer, Frame Sequential Interpolation for Discrete Level-of-Detail Rendering, 2008, Equation 2.
// Different here: of things that move by their own two placements.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "runtime/discrete/director.h"

namespace overlook::discrete {

// From clip coordinates of one frame to those of the other (view::projection: depth near_m / depth), homogeneous.
struct Reprojection {
    glm::mat4 old_from_new{1}, new_from_old{1};
};
// Of a thing that stood at `before` and stands at `now`; the same placement twice: of all that does not move.
Reprojection reprojection(const view::Camera& old_camera, const Placement& before, const view::Camera& new_camera,
                          const Placement& now);

// A rectangle in pixels from the lower left, first inclusive, last exclusive; what depth-buffer values lie in it; and a cone from
// the eye round what is seen.
struct Extent {
    int left = 0, bottom = 0, right = 0, top = 0;
    float near_z = 0, far_z = 0;  // near_z >= far_z, 0..1
    glm::dvec3 towards{0, 0, 1};  // the cone's middle, of length 1: right, up, forward
    double half_rad = 4;          // from its middle to its edge; pi and more: all round
};
// Holds all that a camera sees of a sphere whose middle lies from_eye_m from it, and margin_px more. Empty if it sees nothing.
Extent extent_of(const view::Camera& camera, const glm::dvec3& from_eye_m, double radius_m, int margin_px);

// Which instances under way may be seen in each square of the picture.
struct Tiles {
    static constexpr uint32_t kSide_px = 16, kMost = 16;
    uint32_t columns = 0, rows = 0;
    std::vector<uint32_t> entries;  // [rows, columns, kMost] bottom first: index into what was asked about, plus 1; 0 ends
    uint64_t dropped_count = 0;     // what found no room; the farthest
};
// extents: nearest first. A square is left out that lies in an extent's rectangle but wholly outside its cone.
Tiles tiles_of(const view::Camera& camera, std::span<const Extent> extents);

}  // namespace overlook::discrete
