#include "runtime/lod_sprite/reuse.h"

#include <gtest/gtest.h>

#include "tests/runtime/lod_sprite/sprite_fixture.h"

namespace overlook::lod_sprite {
namespace {

constexpr double kFallback_px = 16, kOutside_px = 2;

// 90 degrees high: at depth d a pixel is d / 300 wide.
view::Camera looking_north(uint32_t width_px = 600, uint32_t height_px = 600) {
    view::Camera camera;
    camera.fov_y_deg = 2 * std::atan(height_px / 600.0) * 180 / M_PI;
    camera.width_px = width_px, camera.height_px = height_px;
    return camera;
}

template <class Depth>
Key key_of(const view::Camera& camera, const Depth& depth_m, uint32_t scale = 1) {
    return {camera, scale, 1, test::grid_of(camera, 80, 80, depth_m)};
}

double wall_100_m(double, double) {
    return 100;
}

TEST(Reuse, AtTheKeysOwnPoseLosesNothingAndKeepsItsPromise) {
    for (uint32_t scale : {1u, 2u})
        for (double guard : {1.0, 1.15}) {
            view::Camera camera = looking_north();
            camera.heading_deg = 33, camera.pitch_deg = -12, camera.position_m = {1234.5, -77, 300};
            auto ground_m = [](double right, double up) { return 100 + 3 * right + 10 * up; };
            Reuse reuse = reuse_of(key_of(key_camera(camera, guard), ground_m, scale), camera, kFallback_px, kOutside_px);
            EXPECT_EQ(reuse.lost_share(), 0);
            EXPECT_NEAR(reuse.magnification_p99, 1.0 / scale, 1e-6);
            EXPECT_NEAR(reuse.error_p99_px, 1, 1e-6);
            EXPECT_NEAR(reuse.error_max_px, 1, 1e-6);
        }
}

TEST(Reuse, OfACameraTurnedByHalfTheViewIsOutsideForHalfOfIt) {
    // At a tangent x of -1..0 the key holds the rays whose z in it, 0.707 (1 - x), is at least as long as they are high: 0.470 of
    // the picture.
    view::Camera camera = looking_north();
    Key key = key_of(camera, wall_100_m);
    for (double turn_deg : {45.0, -45.0}) {
        camera.heading_deg = turn_deg;
        EXPECT_NEAR(reuse_of(key, camera, kFallback_px, kOutside_px).outside_share, 0.530, 0.04);
    }
    camera.heading_deg = 180;
    EXPECT_EQ(reuse_of(key, camera, kFallback_px, kOutside_px).outside_share, 1);
    EXPECT_EQ(reuse_of(key, camera, kFallback_px, kOutside_px).error_max_px, kFallback_px);
    EXPECT_EQ(reuse_of(key, camera, kFallback_px, kOutside_px).drawn_max_px, kOutside_px);
    // A guard band takes up what turning brings in.
    camera.heading_deg = 3;
    EXPECT_EQ(reuse_of(key_of(key_camera(looking_north(), 1.2), wall_100_m), camera, kFallback_px, kOutside_px).outside_share, 0);
}

TEST(Reuse, HalfTheWayToAWallDoublesItsTexelsAndItsError) {
    view::Camera camera = looking_north();
    Key key = key_of(camera, wall_100_m, 2);
    camera.position_m.y = 50;
    Reuse reuse = reuse_of(key, camera, kFallback_px, kOutside_px);
    EXPECT_NEAR(reuse.magnification_p99, 1, 0.01);
    EXPECT_NEAR(reuse.error_p99_px, 2, 0.02);
    EXPECT_NEAR(reuse.error_max_px, 2, 0.02);
    EXPECT_EQ(reuse.lost_share(), 0);
}

TEST(Reuse, TwiceTheWayFromAWallHalvesThemAndLeavesThreeQuartersOutside) {
    view::Camera camera = looking_north();
    Key key = key_of(camera, wall_100_m, 2);
    camera.position_m.y = -100;
    Reuse reuse = reuse_of(key, camera, kFallback_px, kOutside_px);
    EXPECT_NEAR(reuse.magnification_p99, 0.25, 0.01);
    EXPECT_NEAR(reuse.outside_share, 0.75, 1e-9);
    EXPECT_EQ(reuse.opened_share, 0);
    EXPECT_EQ(reuse.error_p99_px, kFallback_px);
}

TEST(Reuse, OpensBehindAWallByItsParallax) {
    // A wall at 50 m over the left half, a background at 200 m: s metres to the right open 300 s (1 / 50 - 1 / 200) pixels.
    view::Camera camera = looking_north();
    Key key = key_of(key_camera(camera, 1.15), [](double right, double) { return right < 0 ? 50.0 : 200.0; });
    for (double step_m : {2.0, 5.0, 10.0, 20.0}) {
        camera.position_m.x = step_m;
        double opened_share = 300 * step_m * (1 / 50.0 - 1 / 200.0) / 600;
        EXPECT_NEAR(reuse_of(key, camera, kFallback_px, kOutside_px).opened_share, opened_share, 0.2 * opened_share) << step_m;
        camera.position_m.x = -step_m;
        EXPECT_EQ(reuse_of(key, camera, kFallback_px, kOutside_px).opened_share, 0) << step_m;
    }
}

TEST(Reuse, CountsWhatIsLostWithTheCoarseCutsError) {
    view::Camera camera = looking_north();
    Key key = key_of(key_camera(camera, 1.15), [](double right, double) { return right < 0 ? 50.0 : 200.0; });
    camera.position_m.x = 0.5;  // opens 0.4 %
    Reuse little = reuse_of(key, camera, kFallback_px, kOutside_px);
    EXPECT_NEAR(little.error_p99_px, 1, 0.06);
    EXPECT_EQ(little.error_max_px, kFallback_px);
    camera.position_m.x = 5;  // 3.75 %
    EXPECT_NEAR(reuse_of(key, camera, kFallback_px, kOutside_px).error_p99_px, kFallback_px, 0.06 * kFallback_px);
}

TEST(Reuse, OfNothingButSkyLosesNothingWithinIt) {
    view::Camera camera = looking_north();
    Key key = key_of(key_camera(camera, 1.2), [](double, double) { return test::kSky; });
    camera.position_m = {1e6, -3e5, 4e4};  // infinitely far off is the same from anywhere
    Reuse reuse = reuse_of(key, camera, kFallback_px, kOutside_px);
    EXPECT_EQ(reuse.lost_share(), 0);
    EXPECT_LE(reuse.error_max_px, 1);
    camera.heading_deg = 180;
    EXPECT_EQ(reuse_of(key, camera, kFallback_px, kOutside_px).outside_share, 1);
}

}  // namespace
}  // namespace overlook::lod_sprite
