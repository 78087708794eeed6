#include "runtime/view/box_error.h"

#include <algorithm>
#include <cmath>

#include "runtime/view/pixel_error.h"

namespace overlook::view {
namespace {

struct Span {
    double least = 0, most = 0;

    double farthest() const { return std::max(std::abs(least), std::abs(most)); }
};

// How far along a direction everything of a cylinder lies, from the eye.
Span along(const glm::dvec3& direction, const Cylinder& cylinder, const glm::dvec3& eye_m) {
    double foot = glm::dot(direction, cylinder.foot_m - eye_m), reach = cylinder.reach_m * std::hypot(direction.x, direction.y);
    double low = direction.z * cylinder.low_m, high = direction.z * cylinder.high_m;
    return {foot - reach + std::min(low, high), foot + reach + std::max(low, high)};
}

}  // namespace

BoxErrorBound::BoxErrorBound(const Camera& camera)
    : axes_(axes_of(camera)),
      eye_m_(camera.position_m),
      sides_(sides_of(camera)),
      focal_px_(focal_px(camera)),
      near_m_(camera.near_m),
      corner_secant_(corner_secant(camera)),
      tangent_x_(camera.width_px / (2 * focal_px_)),
      tangent_y_(camera.height_px / (2 * focal_px_)) {}

// What is in the picture is nowhere wider than the picture's corner, nor nearer than its distance times that angle's cosine.
BoxErrorBound::Sight BoxErrorBound::within(double least_depth_m, double distance_m, double right, double up) const {
    double depth_m = std::max({least_depth_m, distance_m / corner_secant_, near_m_});
    double x = std::min(tangent_x_, right), y = std::min(tangent_y_, up);
    return {depth_m, std::min(corner_secant_, std::sqrt(1 + x * x + y * y))};
}

// A cone round the axis is convex: what holds of all corners holds of the box.
BoxErrorBound::Sight BoxErrorBound::of(const glm::dvec3& low_m, const glm::dvec3& high_m) const {
    double least_m = INFINITY, right = 0, up = 0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 at(corner & 1 ? high_m.x : low_m.x, corner & 2 ? high_m.y : low_m.y, corner & 4 ? high_m.z : low_m.z);
        double depth_m = glm::dot(axes_.forward, at - eye_m_);
        least_m = std::min(least_m, depth_m);
        double seen_m = std::max(depth_m, near_m_);
        right = std::max(right, std::abs(glm::dot(axes_.right, at - eye_m_)) / seen_m);
        up = std::max(up, std::abs(glm::dot(axes_.up, at - eye_m_)) / seen_m);
    }
    if (least_m < near_m_) right = up = INFINITY;  // its corners say nothing of where it goes through the near plane
    return within(least_m, glm::length(eye_m_ - glm::clamp(eye_m_, low_m, high_m)), right, up);
}

BoxErrorBound::Sight BoxErrorBound::of(const Cylinder& cylinder) const {
    double ground_m = std::max(0.0, glm::length(glm::dvec2(cylinder.foot_m - eye_m_)) - cylinder.reach_m);
    double eye_up_m = eye_m_.z - cylinder.foot_m.z, up_m = std::clamp(eye_up_m, cylinder.low_m, cylinder.high_m) - eye_up_m;
    double least_m = along(axes_.forward, cylinder, eye_m_).least, nearest_m = std::max(least_m, near_m_);
    return within(least_m, std::hypot(ground_m, up_m), along(axes_.right, cylinder, eye_m_).farthest() / nearest_m,
                  along(axes_.up, cylinder, eye_m_).farthest() / nearest_m);
}

double BoxErrorBound::pixels(const Sight& sight, double error_m) const {
    return error_px_bound(focal_px_, error_m, sight.depth_m, sight.secant);
}

bool BoxErrorBound::may_be_seen(const Cylinder& cylinder) const {
    if (along(axes_.forward, cylinder, eye_m_).most < near_m_) return false;
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const glm::dvec3& side) { return along(side, cylinder, eye_m_).most >= 0; });
}

bool BoxErrorBound::is_within_sides(const Cylinder& cylinder) const {
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const glm::dvec3& side) { return along(side, cylinder, eye_m_).least >= 0; });
}

}  // namespace overlook::view
