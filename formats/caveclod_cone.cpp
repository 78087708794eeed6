// Normal cones in three bytes (octahedral axes: Q. Meyer, J. Suessmuth, G. Sussner, M. Stamminger, G. Greiner, On Floating-Point
// Normal Vectors, 2010).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/caveclod.h"
#include "formats/caveclod_octahedral.h"

namespace overlook::caveclod {
namespace {

constexpr double kSteps = 127, kAngleSteps = 255;
constexpr double kAngleAllowance_rad = 1e-6;  // what acos and the rounding of axes may take away

double angle_rad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

glm::dvec3 axis_of(const NormalCone& cone) {
    return vector_of_octahedral(glm::dvec2(cone.axis[0], cone.axis[1]) / kSteps);
}

double half_angle_rad_of(const NormalCone& cone) {
    return cone.half_angle * (std::numbers::pi / kAngleSteps);
}

NormalCone cone_of(const glm::dvec3& axis, double half_angle_rad) {
    double length = glm::length(axis);
    if (!(length > 0) || !std::isfinite(length)) return {};
    glm::dvec2 at = octahedral_of(axis / length) * kSteps;
    NormalCone cone{{int8_t(std::lround(at.x)), int8_t(std::lround(at.y))}, 255};
    double widened_rad = half_angle_rad + angle_rad(axis / length, axis_of(cone)) + kAngleAllowance_rad;
    cone.half_angle = uint8_t(std::clamp(std::ceil(widened_rad * (kAngleSteps / std::numbers::pi)), 0.0, kAngleSteps));
    return cone;
}

}  // namespace overlook::caveclod
