#include "runtime/view/pixel_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/synthetic_dem.h"

namespace overlook::view {
namespace {

TEST(PixelErrorBound, IsTheTextbookFigureOnTheAxis) {
    // f e / (d - e): one metre at 1,001 m, f = 623.5 px (720 rows, 60 degrees).
    Camera camera;
    EXPECT_NEAR(focal_px(camera), 623.538, 1e-3);
    EXPECT_NEAR(error_px_bound(focal_px(camera), 1, 1001, 1), 0.623538, 1e-6);
}

TEST(PixelErrorBound, IsInfiniteWhereTheErrorReachesTheEye) {
    EXPECT_TRUE(std::isinf(error_px_bound(600, 10, 10, 1)));
    EXPECT_TRUE(std::isinf(error_px_bound(600, 10, 3, 1)));
    EXPECT_EQ(error_px_bound(600, 0, 3, 1), 0);
}

TEST(PixelErrorBound, IsNearlyTwoAndAHalfTimesTheAxisInTheCornerOfAWideFrame) {
    Camera camera;
    double corner = corner_secant(camera);
    EXPECT_NEAR(corner * corner, 2.39, 0.01);
}

// Random points in the frame, moved by at most e: none moves further on the screen than its sphere's bound.
TEST(PixelErrorBound, HoldsForEveryPointOfASphereAnywhereInTheFrame) {
    double nearest = 0;
    for (uint64_t seed = 0; seed < 200000; ++seed) {
        auto share = [&](uint64_t i) { return test::random_share(5, seed, i); };
        auto direction = [&](uint64_t i) {
            double z = 2 * share(i) - 1, turn = 6.283185307 * share(i + 1), side = std::sqrt(1 - z * z);
            return glm::dvec3{side * std::cos(turn), side * std::sin(turn), z};
        };
        Camera camera;
        camera.heading_deg = 360 * share(0), camera.pitch_deg = 120 * share(1) - 60, camera.fov_y_deg = 20 + 100 * share(2);
        if (seed % 2 == 0) std::swap(camera.width_px, camera.height_px);
        Axes axes = axes_of(camera);
        double focal = focal_px(camera), depth = 5 + 500 * share(3);
        double x = (2 * share(4) - 1) * camera.width_px / 2, y = (2 * share(5) - 1) * camera.height_px / 2;
        glm::dvec3 point = (axes.forward + axes.right * (x / focal) + axes.up * (y / focal)) * depth;
        double radius = 30 * share(6), error = depth * share(7) * 0.3;
        glm::dvec3 middle = point + direction(8) * radius;
        glm::dvec3 moved = point + direction(10) * error;
        double bound = error_px_bound_of_sphere(camera, middle, radius * (1 + 1e-9), error);
        double moved_depth = glm::dot(moved, axes.forward);
        ASSERT_GT(moved_depth, 0);
        double moved_px =
            std::hypot(focal * glm::dot(moved, axes.right) / moved_depth - x, focal * glm::dot(moved, axes.up) / moved_depth - y);
        ASSERT_LE(moved_px, bound * (1 + 1e-9)) << seed;
        nearest = std::max(nearest, moved_px / bound);
    }
    EXPECT_GT(nearest, 0.9);
}

// The same for vertical displacements and the tighter bound, by the point's own depth, angle and horizontal distance: it is
// nearly exact.
TEST(PixelErrorBound, OfVerticalErrorsHoldsAnywhereInTheFrameAndIsTight) {
    double nearest = 0;
    for (uint64_t seed = 0; seed < 200000; ++seed) {
        auto share = [&](uint64_t i) { return test::random_share(6, seed, i); };
        Camera camera;
        camera.heading_deg = 360 * share(0), camera.pitch_deg = 180 * share(1) - 90, camera.fov_y_deg = 20 + 100 * share(2);
        if (seed % 2 == 0) std::swap(camera.width_px, camera.height_px);
        Axes axes = axes_of(camera);
        double focal = focal_px(camera), depth = 5 + 500 * share(3), error = depth * share(4) * 0.5;
        double x = (2 * share(5) - 1) * camera.width_px / 2, y = (2 * share(6) - 1) * camera.height_px / 2;
        glm::dvec3 point = (axes.forward + axes.right * (x / focal) + axes.up * (y / focal)) * depth;
        glm::dvec3 moved = point + glm::dvec3{0, 0, share(7) < 0.5 ? error : -error};
        double moved_depth = glm::dot(moved, axes.forward);
        ASSERT_GT(moved_depth, 0);
        double moved_px =
            std::hypot(focal * glm::dot(moved, axes.right) / moved_depth - x, focal * glm::dot(moved, axes.up) / moved_depth - y);
        double bound = error_px_bound_vertical(focal, error, depth, glm::length(point) / depth, std::hypot(point.x, point.y),
                                               std::abs(axes.forward.z));
        ASSERT_LE(moved_px, bound * (1 + 1e-9)) << seed;
        ASSERT_LE(bound, error_px_bound(focal, error, depth, glm::length(point) / depth) * (1 + 1e-12));
        if (bound > 0) nearest = std::max(nearest, moved_px / bound);
    }
    EXPECT_GT(nearest, 0.999);
}

TEST(Camera, IsReadFromFiveOrSixNumbers) {
    auto camera = parse_camera("1,-2.5,3e2,90,-10");
    ASSERT_TRUE(camera.has_value());
    EXPECT_EQ(camera->position_m.y, -2.5);
    EXPECT_EQ(camera->heading_deg, 90);
    EXPECT_EQ(camera->fov_y_deg, 60);
    EXPECT_EQ(parse_camera("0,0,0,0,0,45")->fov_y_deg, 45);
}

TEST(Camera, RefusesWhatIsNoPose) {
    for (const char* text : {"", "1,2,3,4", "1,2,3,4,5,6,7", "a,2,3,4,5", "1,2,3,4,5,", "1,2,nan,4,5", "1,2,3,4,95",
                             "1,2,3,4,5,0", "1,2,3,4,5,175", "1 2 3 4 5"}) {
        auto camera = parse_camera(text);
        ASSERT_FALSE(camera.has_value()) << text;
        EXPECT_EQ(camera.error().exit, Exit::bad_command);
    }
}

TEST(Camera, LooksNorthAtHeadingZeroAndEastAtNinety) {
    Camera camera;
    EXPECT_NEAR(axes_of(camera).forward.y, 1, 1e-12);
    camera.heading_deg = 90;
    EXPECT_NEAR(axes_of(camera).forward.x, 1, 1e-12);
    EXPECT_NEAR(axes_of(camera).right.y, -1, 1e-12);
    camera.pitch_deg = 90;
    EXPECT_NEAR(axes_of(camera).forward.z, 1, 1e-12);
}

}  // namespace
}  // namespace overlook::view
