// How fine a cut is on the screen: of one error everywhere, or finer in parts of the picture.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "runtime/view/camera.h"
#include "runtime/view/picture_mask.h"
#include "runtime/view/pixel_error.h"

namespace overlook::view {

struct PixelDetail {
    double error_px = 1;  // > 0
    double morph = 0;     // of terrains alone (terrain::Refiner::cut_by_pixels)
    // What comes nearer than near_depth_m (along the camera's axis) keeps near_error_px > 0, at most error_px.
    double near_depth_m = 0, near_error_px = 1;
    // So does, if there is another camera, what that one does not see for certain: the frame's part outside its four sides.
    std::optional<Camera> seen_by{};
    // And so does what may touch a marked part of the picture.
    PictureMask finer_in{};
    // Of meshes alone: what may lie on an outline keeps near_error_px as well.
    bool keeps_outlines = false;
};

struct Range {
    double low = 0, high = 0;
};

// May what lies between these, along a camera's right, up and forward axes, come into a marked part of its picture?
class MaskOnScreen {
  public:
    MaskOnScreen(const Camera& camera, const PictureMask& mask);
    bool is_empty() const { return is_empty_; }
    bool is_touched(const Range& right, const Range& up, const Range& forward) const;

  private:
    PictureMask mask_;
    bool is_empty_;
    double near_m_, share_per_tangent_x_, share_per_tangent_y_;
};

// Which spheres may come into the parts that are to be finer, for one camera.
class FinerParts {
  public:
    FinerParts(const Camera& camera, const PixelDetail& detail);

    bool is_empty() const { return near_depth_m_ <= 0 && side_count_ == 0 && finer_in_.is_empty(); }
    double error_px() const { return error_px_; }  // of these parts
    // True of a sphere if it is of another within it. middle: in the camera's axes; radius_m >= 0.
    bool touch(const SphereErrorBound::Place& middle, double radius_m) const;

  private:
    struct Side {
        glm::dvec3 inwards{0};  // in the camera's axes
        double length = 0, offset_m = 0;
    };
    double error_px_, near_depth_m_;
    uint32_t side_count_ = 0;  // of what another camera sees
    std::array<Side, 4> sides_;
    MaskOnScreen finer_in_;
};

}  // namespace overlook::view
