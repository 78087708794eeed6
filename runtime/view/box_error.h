// The bound of pixel_error.h for boxes and upright cylinders, of one camera.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "runtime/view/camera.h"

namespace overlook::view {

// Everything within reach_m of the vertical line over `foot_m`, from there low_m to high_m up.
struct Cylinder {
    glm::dvec3 foot_m{0};
    double reach_m = 0, low_m = 0, high_m = 0;
};

class BoxErrorBound {
  public:
    explicit BoxErrorBound(const Camera& camera);

    // Of those parts of a thing that are in the picture: their least depth, > 0, and widest angle's secant, >= 1.
    struct Sight {
        double depth_m = 0, secant = 1;
    };
    Sight of(const glm::dvec3& low_m, const glm::dvec3& high_m) const;
    Sight of(const Cylinder& cylinder) const;

    // How many pixels something within error_m of where it should be is displaced at most; as error_px_bound.
    double pixels(const Sight& sight, double error_m) const;
    // The greatest error, but for rounding, that displaces nothing by more than so many pixels.
    double metres(const Sight& sight, double pixels) const {
        constexpr double kLess = 1 - 1e-12;
        return kLess * pixels * sight.depth_m / (focal_px_ * sight.secant + pixels);
    }

    // False only if nothing of it can be in the picture, or before the near plane.
    bool may_be_seen(const Cylinder& cylinder) const;
    // True only if no side of the picture cuts it.
    bool is_within_sides(const Cylinder& cylinder) const;

  private:
    Sight within(double least_depth_m, double distance_m, double right, double up) const;

    Axes axes_;
    glm::dvec3 eye_m_;
    std::array<glm::dvec3, 4> sides_;
    double focal_px_, near_m_, corner_secant_, tangent_x_, tangent_y_;
};

}  // namespace overlook::view
