#include "runtime/view/pixel_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overlook::view {

double error_px_bound_vertical(double focal_px, double error_m, double depth_min_m, double secant_max, double horizontal_max_m,
                               double axis_rise) {
    if (error_m <= 0) return 0;
    if (depth_min_m <= error_m * axis_rise) return std::numeric_limits<double>::infinity();
    return focal_px * error_m * std::min(secant_max, horizontal_max_m / depth_min_m) / (depth_min_m - error_m * axis_rise);
}

SphereErrorBound::SphereErrorBound(const Camera& camera)
    : axes_(axes_of(camera)),
      focal_px_(focal_px(camera)),
      near_m_(camera.near_m),
      corner_secant_(corner_secant(camera)),
      corner_cosine_(1 / corner_secant_) {}

double error_px_bound_of_sphere(const Camera& camera, const glm::dvec3& middle_m, double radius_m, double error_m) {
    SphereErrorBound bound(camera);
    return bound(bound.place_of(middle_m - camera.position_m), radius_m, error_m);
}

}  // namespace overlook::view
