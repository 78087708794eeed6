#include "runtime/view/flight.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace overlook::view {
namespace {

using scene::Flight;
using scene::Interpolation;
using scene::Key;

Key key_at(double time_s, double x_m, double heading_deg = 0) {
    Key key;
    key.time_s = time_s;
    key.position_m = {x_m, 2 * x_m, -x_m};
    key.heading_deg = heading_deg;
    return key;
}
Flight flight_of(Interpolation interpolation, std::vector<Key> keys) {
    Flight flight;
    flight.interpolation = interpolation;
    flight.keys = std::move(keys);
    return flight;
}
double x_at(const Flight& flight, double time_s) {
    return camera_at(flight, time_s, {}).position_m.x;
}

const std::vector<Key> kUneven = {key_at(0, 0, 350), key_at(1, 3, 20), key_at(3, -4, 100), key_at(3.5, 10, -100),
                                  key_at(7, 1, 0)};

TEST(Flight, IsExactlyOnItsKeys) {
    for (Interpolation interpolation : {Interpolation::constant, Interpolation::linear, Interpolation::smooth}) {
        Flight flight = flight_of(interpolation, kUneven);
        for (const Key& key : kUneven) {
            Camera camera = camera_at(flight, key.time_s, {});
            EXPECT_EQ(camera.position_m, glm::dvec3(key.position_m[0], key.position_m[1], key.position_m[2]));
            EXPECT_EQ(camera.heading_deg, key.heading_deg);
        }
    }
}

TEST(Flight, StaysOnItsFirstAndLastKeyOutside) {
    Flight flight = flight_of(Interpolation::smooth, {key_at(2, 5), key_at(3, 9), key_at(4, 7)});
    for (double before_s : {-1e300, 0.0, 1.999, std::nan("")}) EXPECT_EQ(x_at(flight, before_s), 5);
    for (double after_s : {4.0, 4.001, 1e300}) EXPECT_EQ(x_at(flight, after_s), 7);
}

TEST(Flight, ConstantWaitsAndLeaps) {
    Flight flight = flight_of(Interpolation::constant, {key_at(0, 5), key_at(1, 9)});
    EXPECT_EQ(x_at(flight, std::nextafter(1.0, 0.0)), 5);
    EXPECT_EQ(x_at(flight, 1), 9);
}

TEST(Flight, LinearKeysMakeAStraightLineAtConstantSpeed) {
    Flight flight = flight_of(Interpolation::linear, {key_at(1, 10), key_at(5, 30)});
    for (int i = 0; i <= 64; ++i) {
        double time_s = 1 + i / 16.0;
        glm::dvec3 at_m = camera_at(flight, time_s, {}).position_m;
        EXPECT_EQ(at_m, glm::dvec3(1, 2, -1) * (10 + 5 * (time_s - 1)));
    }
}

TEST(Flight, SmoothKeepsAStraightLineAtConstantSpeed) {
    std::vector<Key> keys;
    for (double time_s : {0.0, 1.0, 1.5, 4.0, 8.0}) keys.push_back(key_at(time_s, 3 * time_s + 1));
    Flight flight = flight_of(Interpolation::smooth, keys);
    for (int i = 0; i <= 80; ++i) EXPECT_NEAR(x_at(flight, i / 10.0), 3 * (i / 10.0) + 1, 1e-12);
    Flight two = flight_of(Interpolation::smooth, {key_at(0, 1), key_at(4, 13)});
    for (int i = 0; i <= 40; ++i) EXPECT_NEAR(x_at(two, i / 10.0), 3 * (i / 10.0) + 1, 1e-12);
}

TEST(Flight, SmoothKeepsAParabolaInTime) {
    auto parabola = [](double t) { return 2 * t * t - 7 * t + 3; };
    std::vector<Key> keys;
    for (double time_s : {0.0, 1.0, 1.5, 4.0, 8.0}) keys.push_back(key_at(time_s, parabola(time_s)));
    Flight flight = flight_of(Interpolation::smooth, keys);
    for (int i = 0; i <= 80; ++i) EXPECT_NEAR(x_at(flight, i / 10.0), parabola(i / 10.0), 1e-11);
}

// Times 0, 1, 3, 4 with x = 0, 1, 5, 0: d = 1, 2, -5; m1 = (2*1 + 1*2)/3 = 4/3, m2 = (1*2 + 2*-5)/3 = -8/3. At t = 2 (s = 1/2,
// h = 2): 1 + 4/2 + (1/8) * 2 * 4/3 - (1/8) * 2 * -8/3 = 3 + 1/3 + 2/3 = 4. At t = 1.5 (s = 1/4):
// 1 + (10/64) * 4 + (9/64) * 2 * 4/3 - (3/64) * 2 * -8/3 = 1 + 40/64 + 24/64 + 16/64 = 2.25.
TEST(Flight, SmoothHasTheValuesWorkedOutByHand) {
    Flight flight = flight_of(Interpolation::smooth, {key_at(0, 0), key_at(1, 1), key_at(3, 5), key_at(4, 0)});
    EXPECT_DOUBLE_EQ(x_at(flight, 2), 4);
    EXPECT_DOUBLE_EQ(x_at(flight, 1.5), 2.25);
    // The ends: m0 = 1 - 1 * (2 - 1) / 3 = 2/3, so at t = 1/2: 1/2 + (1/8)(2/3) - (1/8)(4/3) = 5/12.
    EXPECT_DOUBLE_EQ(x_at(flight, 0.5), 5.0 / 12);
}

TEST(Flight, SmoothHasNoJumpInItsVelocity) {
    Flight flight = flight_of(Interpolation::smooth, kUneven);
    const double small_s = 1e-6;
    for (size_t i = 1; i + 1 < kUneven.size(); ++i) {
        double t = kUneven[i].time_s;
        double before = (x_at(flight, t) - x_at(flight, t - small_s)) / small_s;
        double after = (x_at(flight, t + small_s) - x_at(flight, t)) / small_s;
        EXPECT_NEAR(before, after, 1e-3) << i;
    }
}

TEST(Flight, TurnsTheShorterWayRound) {
    for (Interpolation interpolation : {Interpolation::linear, Interpolation::smooth}) {
        Flight flight = flight_of(interpolation, {key_at(0, 0, 350), key_at(1, 10, 20)});
        EXPECT_NEAR(std::remainder(camera_at(flight, 0.5, {}).heading_deg - 5, 360.0), 0, 1e-9);
        flight = flight_of(interpolation, {key_at(0, 0, 20), key_at(1, 10, 350)});
        EXPECT_NEAR(std::remainder(camera_at(flight, 0.5, {}).heading_deg - 5, 360.0), 0, 1e-9);
    }
    // Round and round at one speed: no wobble where the numbers start again.
    std::vector<Key> round;
    for (int i = 0; i <= 16; ++i) round.push_back(key_at(i, 0, std::remainder(90.0 * i, 360.0)));
    Flight flight = flight_of(Interpolation::smooth, round);
    for (int i = 0; i < 160; ++i)
        EXPECT_NEAR(std::remainder(camera_at(flight, i / 10.0, {}).heading_deg - 9.0 * i, 360.0), 0, 1e-9) << i;
}

TEST(Flight, KeepsPitchAndFieldOfViewInTheirRange) {
    std::vector<Key> keys = {key_at(0, 0), key_at(1, 0), key_at(2, 0), key_at(3, 0)};
    keys[1].pitch_deg = keys[2].pitch_deg = 90;
    keys[1].fov_y_deg = keys[2].fov_y_deg = 170;
    Flight flight = flight_of(Interpolation::smooth, keys);
    Camera top = camera_at(flight, 1.5, {});
    EXPECT_EQ(top.pitch_deg, 90);
    EXPECT_EQ(top.fov_y_deg, 170);
}

TEST(Flight, TakesFromTheBaseWhatItDoesNotSay) {
    Camera base;
    base.fov_y_deg = 33;
    base.width_px = 17;
    base.near_m = 0.125;
    std::vector<Key> keys = {key_at(0, 0), key_at(1, 1)};
    keys[1].fov_y_deg = 43;
    Flight flight = flight_of(Interpolation::linear, keys);
    EXPECT_EQ(camera_at(flight, 0, base).fov_y_deg, 33);
    EXPECT_EQ(camera_at(flight, 0.5, base).fov_y_deg, 38);
    EXPECT_EQ(camera_at(flight, 0.5, base).width_px, 17u);
    EXPECT_EQ(camera_at(flight, 0.5, base).near_m, 0.125);
}

TEST(Flight, HasTheSameBitsEverywhere) {
    Flight flight = flight_of(Interpolation::smooth, kUneven);
    struct Pose {
        double time_s;
        uint64_t x, heading;
    };
    for (const Pose& pose :
         {Pose{0.1, 0x3fdfae147ae147ad, 0x40760b3333333333}, Pose{2.3, 0xc020a0298191f441, 0x4012c2e6bdc80578},
          Pose{3.4, 0x401d60059e0c0dca, 0x406cadef07e640f2}, Pose{6.9, 0x400ed880bb3ee708, 0x4035ea0ea0ea0e88}}) {
        Camera camera = camera_at(flight, pose.time_s, {});
        EXPECT_EQ(std::bit_cast<uint64_t>(camera.position_m.x), pose.x)
            << fmt::format("{:#x}", std::bit_cast<uint64_t>(camera.position_m.x));
        EXPECT_EQ(std::bit_cast<uint64_t>(camera.heading_deg), pose.heading)
            << fmt::format("{:#x}", std::bit_cast<uint64_t>(camera.heading_deg));
    }
}

TEST(Layer, SeesItsAssetAsTheWorldDoes) {
    scene::Transform transform;
    transform.translation_m = {1e5, -300, 40};
    transform.rotation_z_deg = 30;
    transform.scale = 2.5;
    Camera camera;
    camera.position_m = {1e5 + 50, -900, 700};
    camera.heading_deg = 25;
    camera.pitch_deg = -20;
    Camera local = camera_into(transform, camera);

    // A point of the asset, by hand into the world: scaled, turned, moved. Its direction from both cameras is one.
    glm::dvec3 point_m{10, 400, 30};
    double c = std::sqrt(0.75), s = 0.5;
    glm::dvec3 world_m = 2.5 * glm::dvec3(c * 10 - s * 400, s * 10 + c * 400, 30) + glm::dvec3(1e5, -300, 40);
    Axes axes = axes_of(camera), local_axes = axes_of(local);
    glm::dvec3 seen = world_m - camera.position_m, seen_local = (point_m - local.position_m) * 2.5;
    EXPECT_NEAR(glm::dot(seen, axes.right), glm::dot(seen_local, local_axes.right), 1e-7);
    EXPECT_NEAR(glm::dot(seen, axes.up), glm::dot(seen_local, local_axes.up), 1e-7);
    EXPECT_NEAR(glm::dot(seen, axes.forward), glm::dot(seen_local, local_axes.forward), 1e-7);
    EXPECT_DOUBLE_EQ(local.near_m * 2.5, camera.near_m);

    Camera back = camera_out_of(transform, local);
    EXPECT_NEAR(glm::distance(back.position_m, camera.position_m), 0, 1e-9);
    EXPECT_DOUBLE_EQ(back.heading_deg, camera.heading_deg);
}

TEST(Layer, ThatIsNotMovedIsSeenExactly) {
    Camera camera;
    camera.position_m = {0.1, 0.7, 1e7 / 3};
    camera.heading_deg = 0.3;
    EXPECT_EQ(camera_into({}, camera).position_m, camera.position_m);
    EXPECT_EQ(camera_into({}, camera).heading_deg, camera.heading_deg);
    EXPECT_EQ(camera_out_of({}, camera).position_m, camera.position_m);
}

}  // namespace
}  // namespace overlook::view
