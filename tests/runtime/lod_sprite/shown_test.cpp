#include "runtime/lod_sprite/shown.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/runtime/lod_sprite/sprite_fixture.h"

namespace overlook::lod_sprite {
namespace {

constexpr double kMostTexel_px = 1.5;

// 90 degrees high: at depth d a pixel is d / 300 wide.
view::Camera looking_north() {
    view::Camera camera;
    camera.fov_y_deg = 90;
    camera.width_px = 600, camera.height_px = 600;
    return camera;
}

template <class Depth>
Key key_of(const view::Camera& camera, const Depth& depth_m, uint32_t scale = 2) {
    return {camera, scale, 1, test::grid_of(camera, 80, 80, depth_m)};
}

double wall_100_m(double, double) {
    return 100;
}

double open_share(const Shown& shown) {
    return double(std::count(shown.is_open.begin(), shown.is_open.end(), 1)) / double(shown.is_open.size());
}

// Is the picture open at these shares of it?
bool is_open_at(const Shown& shown, double x, double y) {
    return shown.is_open[size_t(y * shown.rows) * shown.columns + size_t(x * shown.columns)];
}

TEST(Shown, IsEverythingAtTheKeysOwnPose) {
    for (double guard : {1.0, 1.15}) {
        view::Camera camera = looking_north();
        camera.heading_deg = 33, camera.pitch_deg = -12, camera.position_m = {1234.5, -77, 300};
        auto steps_m = [](double right, double up) {
            return right + 0.3 * up < 0.1 ? 50 + 3 * right : up > 0.4 ? test::kSky : 900;
        };
        EXPECT_EQ(open_share(shown_by(key_of(key_camera(camera, guard), steps_m), camera, kMostTexel_px)), 0) << guard;
    }
}

// A wall at 50 m over the left half, a background at 200 m: s metres to the right open 300 s (1 / 50 - 1 / 200) pixels behind it.
TEST(Shown, IsOpenBehindAWallWhereParallaxHasTornIt) {
    view::Camera camera = looking_north();
    Key key = key_of(key_camera(camera, 1.15), [](double right, double) { return right < 0 ? 50.0 : 200.0; });
    for (double step_m : {1.0, 2.0, 5.0}) {
        camera.position_m.x = step_m;
        double opened_share = 300 * step_m * (1 / 50.0 - 1 / 200.0) / 600;
        Shown shown = shown_by(key, camera, kMostTexel_px);
        EXPECT_NEAR(open_share(shown), opened_share, 0.03) << step_m;
        EXPECT_TRUE(is_open_at(shown, 0.5 - step_m * 300 / 125 / 600, 0.5)) << step_m;  // what is 125 m away there
        EXPECT_EQ(shown.behind_share + shown.nothing_share, 0) << step_m;
        camera.position_m.x = -step_m;
        EXPECT_EQ(open_share(shown_by(key, camera, kMostTexel_px)), 0) << step_m;
    }
}

TEST(Shown, IsNotWhatIsSeenFromBehind) {
    view::Camera camera = looking_north();
    Key key = key_of(camera, wall_100_m);
    camera.position_m.y = 200, camera.heading_deg = 180;
    Shown shown = shown_by(key, camera, kMostTexel_px);
    EXPECT_EQ(open_share(shown), 1);
    EXPECT_EQ(shown.behind_share, 1);
    // Past the wall, looking on: nothing of it is in view.
    camera.heading_deg = 0;
    shown = shown_by(key, camera, kMostTexel_px);
    EXPECT_EQ(shown.nothing_share, 1);
    Reuse reuse = reuse_of(key, camera, 16, 1, &shown);
    EXPECT_EQ(reuse.error_p99_px, 16);
    EXPECT_EQ(reuse.drawn_p99_px, 1);
    EXPECT_GE(reuse.lost_share(), 1 - 1e-9);
}

TEST(Shown, IsNotWhatHasBecomeTooCoarse) {
    view::Camera camera = looking_north();
    Key key = key_of(camera, wall_100_m);
    camera.position_m.y = 66;  // texels of half a pixel become 1.47
    EXPECT_EQ(open_share(shown_by(key, camera, kMostTexel_px)), 0);
    camera.position_m.y = 67;
    EXPECT_EQ(open_share(shown_by(key, camera, kMostTexel_px)), 1);
}

TEST(Shown, IsTheSkyFromAnywhereAndNothingBesideThePicture) {
    view::Camera camera = looking_north();
    Key key = key_of(camera, [](double, double) { return test::kSky; });
    camera.position_m = {1e6, -3e5, 4e4};
    EXPECT_EQ(open_share(shown_by(key, camera, kMostTexel_px)), 0);
    camera.heading_deg = 45;
    EXPECT_NEAR(shown_by(key, camera, kMostTexel_px).nothing_share, 0.530, 0.02);  // see Reuse.OfACameraTurnedByHalfTheView...
    camera.heading_deg = 180;
    EXPECT_EQ(shown_by(key, camera, kMostTexel_px).nothing_share, 1);
}

// All round what is nearer, not in it, and no farther away than that.
TEST(Shown, IsOpenBesideWhatIsNearer) {
    Shown shown{5, 4, std::vector<uint8_t>(20, 0), std::vector<double>(20, 1.0 / 200)};
    shown.inverse_depths_per_m[1 * 5 + 1] = 1.0 / 50;
    shown.inverse_depths_per_m[0] = 0;  // the sky
    EXPECT_EQ(open_beside_nearer(shown, 0), shown.is_open);
    EXPECT_EQ(open_beside_nearer(shown, 40), shown.is_open);
    std::vector<uint8_t> wanted = {1, 1, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_EQ(open_beside_nearer(shown, 100), wanted);
}

}  // namespace
}  // namespace overlook::lod_sprite
