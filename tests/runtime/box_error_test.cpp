// No point of a box or a cylinder that is in the picture is displaced by more than its bound, and the bound is not far above
// that.
#include "runtime/view/box_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

namespace overlook::view {
namespace {

std::optional<glm::dvec2> seen_px(const Camera& camera, const glm::dvec3& at_m) {
    Axes axes = axes_of(camera);
    glm::dvec3 from = at_m - camera.position_m;
    double depth_m = glm::dot(axes.forward, from);
    if (depth_m < camera.near_m) return std::nullopt;
    return glm::dvec2(glm::dot(axes.right, from), glm::dot(axes.up, from)) * (focal_px(camera) / depth_m);
}
bool is_in_picture(const Camera& camera, const glm::dvec2& px) {
    return std::abs(px.x) <= camera.width_px / 2.0 && std::abs(px.y) <= camera.height_px / 2.0;
}

struct Random {
    std::mt19937 numbers{7};
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(numbers); }
    glm::dvec3 direction() {
        std::normal_distribution<double> normal;
        return glm::normalize(glm::dvec3(normal(numbers), normal(numbers), normal(numbers)) + 1e-9);
    }
};

Camera any_camera(Random& random) {
    Camera camera;
    camera.position_m = {random.in(-3, 3), random.in(-3, 3), random.in(0, 3)};
    camera.heading_deg = random.in(0, 360), camera.pitch_deg = random.in(-60, 30), camera.fov_y_deg = random.in(30, 90);
    camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.1;
    return camera;
}

// The greatest displacement by error_m of points that are in the picture; none: nothing is.
template <class Place>
std::optional<double> greatest_px(Random& random, const Camera& camera, double error_m, const Place& place) {
    std::optional<double> greatest;
    for (int n = 0; n < 400; ++n) {
        glm::dvec3 at = place();
        auto one = seen_px(camera, at);
        if (!one || !is_in_picture(camera, *one)) continue;
        greatest = std::max(greatest.value_or(0), 0.0);
        if (auto other = seen_px(camera, at + error_m * random.direction()))
            greatest = std::max(*greatest, glm::length(*other - *one));
    }
    return greatest;
}

struct Tally {
    int seen = 0;
    double measured = 0, bound = 0;

    void add(double measured_px, double bound_px) {
        EXPECT_LE(measured_px, bound_px * (1 + 1e-9));
        if (!std::isfinite(bound_px)) return;
        ++seen, measured += measured_px, bound += bound_px;
    }
};

TEST(BoxError, BoundsWhateverIsInThePicture) {
    Random random;
    Tally boxes, cylinders;
    for (int n = 0; n < 3000; ++n) {
        Camera camera = any_camera(random);
        BoxErrorBound bound(camera);
        double error_m = random.in(0.001, 0.05);
        glm::dvec3 low(random.in(-8, 8), random.in(-8, 8), random.in(-1, 2)),
            size(random.in(0.1, 2), random.in(0.1, 2), random.in(0.1, 2));
        auto in_box = [&] { return low + size * glm::dvec3(random.in(0, 1), random.in(0, 1), random.in(0, 1)); };
        if (auto px = greatest_px(random, camera, error_m, in_box))
            boxes.add(*px, bound.pixels(bound.of(low, low + size), error_m));

        Cylinder cylinder{low, size.x / 2, -size.y / 4, size.z};
        auto in_cylinder = [&] {
            double angle = random.in(0, 2 * M_PI), out = cylinder.reach_m * std::sqrt(random.in(0, 1));
            return low + glm::dvec3(out * std::cos(angle), out * std::sin(angle), random.in(cylinder.low_m, cylinder.high_m));
        };
        auto px = greatest_px(random, camera, error_m, in_cylinder);
        EXPECT_TRUE(!px || bound.may_be_seen(cylinder));
        if (px) cylinders.add(*px, bound.pixels(bound.of(cylinder), error_m));
        if (!bound.is_within_sides(cylinder)) continue;
        for (int k = 0; k < 20; ++k) {
            auto at = seen_px(camera, in_cylinder());
            EXPECT_TRUE(!at || is_in_picture(camera, *at * (1 - 1e-9)));
        }
    }
    EXPECT_GT(boxes.seen, 300);
    EXPECT_GT(cylinders.seen, 300);
    EXPECT_LT(boxes.bound, 3 * boxes.measured);
    EXPECT_LT(cylinders.bound, 3 * cylinders.measured);
}

TEST(BoxError, MetresAreThoseOfPixels) {
    Random random;
    for (int n = 0; n < 100; ++n) {
        BoxErrorBound bound(any_camera(random));
        BoxErrorBound::Sight sight = bound.of({4, 5, 0}, {6, 7, 2});
        double pixels = random.in(0.1, 50);
        EXPECT_NEAR(bound.pixels(sight, bound.metres(sight, pixels)), pixels, 1e-9 * pixels);
    }
}

}  // namespace
}  // namespace overlook::view
