#include "tools/make_sample/heart_leaf.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace overlook::sample {
namespace {

constexpr double kDegrees = 57.29577951308232;
constexpr double kWidest_rad = 165 / kDegrees;

struct Knot {
    double angle_deg, radius;
};
constexpr std::array<Knot, 11> kKnots{{{0, 0.76},
                                       {5, 0.685},
                                       {12, 0.61},
                                       {22, 0.535},
                                       {38, 0.465},
                                       {60, 0.415},
                                       {85, 0.375},
                                       {110, 0.34},
                                       {132, 0.28},
                                       {150, 0.19},
                                       {180, 0.02}}};

}  // namespace

double heart_radius(double angle_rad) {
    double angle_deg = std::clamp(angle_rad * kDegrees, 0.0, 179.999);
    size_t i = 0;
    while (kKnots[i + 1].angle_deg <= angle_deg) ++i;
    const Knot &a = kKnots[i], &b = kKnots[i + 1];
    return a.radius + (b.radius - a.radius) * (angle_deg - a.angle_deg) / (b.angle_deg - a.angle_deg);
}

glm::dvec2 heart_midrib(double share) {
    return {0, kHeartFoot + 0.74 * share};
}

glm::dvec2 heart_rim(double share) {
    double angle = kWidest_rad * (1 - share) * (1 - 0.25 * share);
    return glm::dvec2(0, kHeartFoot) + heart_radius(angle) * glm::dvec2(std::sin(angle), std::cos(angle));
}

double heart_share(const glm::dvec2& at) {
    // The line from midrib to rim on whose left and right the place lies; both ends move forward with the share.
    double low = 0, high = 1;
    for (int i = 0; i < 20; ++i) {
        double middle = (low + high) / 2;
        glm::dvec2 from = heart_midrib(middle), along = heart_rim(middle) - from, to = glm::dvec2(std::abs(at.x), at.y) - from;
        (along.x * to.y - along.y * to.x > 0 ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace overlook::sample
