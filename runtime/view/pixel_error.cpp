#include "runtime/view/pixel_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overlook::view {

double error_px_bound(double focal_px, double error_m, double depth_min_m, double secant_max) {
    if (error_m <= 0) return 0;
    if (depth_min_m <= error_m) return std::numeric_limits<double>::infinity();
    return focal_px * error_m * secant_max / (depth_min_m - error_m);
}

double error_px_bound_vertical(double focal_px, double error_m, double depth_min_m, double secant_max, double horizontal_max_m,
                               double axis_rise) {
    if (error_m <= 0) return 0;
    if (depth_min_m <= error_m * axis_rise) return std::numeric_limits<double>::infinity();
    return focal_px * error_m * std::min(secant_max, horizontal_max_m / depth_min_m) / (depth_min_m - error_m * axis_rise);
}

double error_px_bound_of_sphere(const Camera& camera, const glm::dvec3& middle_m, double radius_m, double error_m) {
    Axes axes = axes_of(camera);
    glm::dvec3 to_middle = middle_m - camera.position_m;
    double depth = glm::dot(axes.forward, to_middle);
    double side = std::hypot(glm::dot(axes.right, to_middle), glm::dot(axes.up, to_middle));
    double distance_min = std::max(0.0, glm::length(to_middle) - radius_m);
    double corner = corner_secant(camera);

    double depth_min = std::max({depth - radius_m, distance_min / corner, camera.near_m});
    double tangent_max = (side + radius_m) / depth_min;
    double secant_max = std::min(corner, std::sqrt(1 + tangent_max * tangent_max));
    return error_px_bound(focal_px(camera), error_m, depth_min, secant_max);
}

}  // namespace overlook::view
