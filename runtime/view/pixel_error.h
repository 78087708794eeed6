// The one place where metres of error become pixels: bakers and runtime alike ask here.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "runtime/view/camera.h"

namespace overlook::view {

// Bounds how far on the screen anything within error_m of where it should be is displaced, anywhere in the frame.
//
// Let a point p be in the frame at depth z = d cos(theta) (d its distance, theta its angle from the axis), and let p' lie
// within error_m of it. With u the unit vector p' - p, |x'/z' - x/z| = e |z u_x - x u_z| / (z z') <= e d / (z z'), and
// z' >= z - e, so the displacement is at most
//
//     focal_px * error_m * sec(theta) / (z - error_m)            [pixels]
//
// which grows with error_m and theta and falls with z: the largest over a region is at its least depth and widest angle.
// (With z = d cos(theta) this is f e / (d cos^2(theta)), less the error for motion towards the eye.)
//
// depth_min_m: least depth over the region's part in the frame, > 0; secant_max: of its widest angle in the frame, >= 1.
// Returns infinity where depth_min_m <= error_m (the error can reach the eye) and 0 for error_m = 0.
inline double error_px_bound(double focal_px, double error_m, double depth_min_m, double secant_max) {
    if (error_m <= 0) return 0;
    if (depth_min_m <= error_m) return std::numeric_limits<double>::infinity();
    return focal_px * error_m * secant_max / (depth_min_m - error_m);
}

// The same where the error is along the world's vertical, as a height field's is: for it |z u_x - x u_z| and |z u_y - y u_z| are
// two sides of the cross product of p and the vertical u, whose length is p's horizontal distance h from the eye, and the depth
// changes by error_m * |u_z| at most. So the displacement is at most
//
//     focal_px * error_m * min(sec(theta), h / z) / (z - error_m * |u_z|)            [pixels]
//
// which is far less for a camera that looks down. horizontal_max_m: the region's greatest horizontal distance; axis_rise: |u_z|,
// the sine of the axis's pitch, 0 .. 1.
double error_px_bound_vertical(double focal_px, double error_m, double depth_min_m, double secant_max, double horizontal_max_m,
                               double axis_rise);

// The bound of error_px_bound for spheres, of one camera: a sphere's least depth and widest angle are bounded by those of the
// sphere, and by the frame's corner since what is outside the frame is not seen.
class SphereErrorBound {
  public:
    explicit SphereErrorBound(const Camera& camera);

    // A place relative to the eye in the camera's own axes.
    struct Place {
        double right = 0, up = 0, forward = 0;
    };
    Place place_of(const glm::dvec3& from_eye_m) const {
        return {glm::dot(axes_.right, from_eye_m), glm::dot(axes_.up, from_eye_m), glm::dot(axes_.forward, from_eye_m)};
    }
    double operator()(const Place& middle, double radius_m, double error_m) const {
        double side_squared = middle.right * middle.right + middle.up * middle.up;
        double distance_min = std::sqrt(side_squared + middle.forward * middle.forward) - radius_m;
        double depth_min = std::max(std::max(middle.forward - radius_m, distance_min * corner_cosine_), near_m_);
        double tangent_max = (std::sqrt(side_squared) + radius_m) / depth_min;
        double secant_max = std::min(corner_secant_, std::sqrt(1 + tangent_max * tangent_max));
        return error_px_bound(focal_px_, error_m, depth_min, secant_max);
    }

  private:
    Axes axes_;
    double focal_px_, near_m_, corner_secant_, corner_cosine_;
};

// The same of one sphere of the world.
double error_px_bound_of_sphere(const Camera& camera, const glm::dvec3& middle_m, double radius_m, double error_m);

}  // namespace overlook::view
