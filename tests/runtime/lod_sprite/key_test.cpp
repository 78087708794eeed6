#include "runtime/lod_sprite/key.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/lod_sprite/pose_track.h"

namespace overlook::lod_sprite {
namespace {

view::Camera camera_at(const glm::dvec3& position_m, double heading_deg = 0, double pitch_deg = 0) {
    view::Camera camera;
    camera.position_m = position_m;
    camera.heading_deg = heading_deg, camera.pitch_deg = pitch_deg;
    return camera;
}

TEST(KeyCamera, IsLargerByTheGuardWithPixelsOfTheSameSize) {
    view::Camera frame = camera_at({1, 2, 3}, 40, -10);
    frame.fov_y_deg = 47, frame.width_px = 1281, frame.height_px = 719, frame.near_m = 0.3;
    for (double guard : {1.0, 1.15, 1.5, 2.0}) {
        view::Camera key = key_camera(frame, guard);
        EXPECT_EQ(key.width_px, std::ceil(guard * 1281));
        EXPECT_EQ(key.height_px, std::ceil(guard * 719));
        EXPECT_NEAR(view::focal_px(key), view::focal_px(frame), 1e-9 * view::focal_px(frame));
        EXPECT_EQ(key.position_m, frame.position_m);
        EXPECT_EQ(key.heading_deg, frame.heading_deg);
        EXPECT_EQ(key.pitch_deg, frame.pitch_deg);
        EXPECT_EQ(key.near_m, frame.near_m);
    }
}

TEST(KeyCamera, SeesAtMost170Degrees) {
    view::Camera frame;
    frame.fov_y_deg = 150, frame.width_px = 300, frame.height_px = 300;
    view::Camera key = key_camera(frame, 10);
    EXPECT_LE(key.fov_y_deg, 170);
    EXPECT_GT(key.fov_y_deg, 169.9);
    EXPECT_EQ(key.width_px, key.height_px);
    EXPECT_NEAR(view::focal_px(key), view::focal_px(frame), 1e-9);
    // A frame that is wider by itself stays whole.
    frame.width_px = 6000;
    EXPECT_EQ(key_camera(frame, 2).width_px, 6000u);
}

TEST(Link, PutsPointsWhereTheKeySeesThem) {
    view::Camera key = camera_at({10, 20, 30}, 90);  // looks east: south is right
    key.fov_y_deg = 90, key.width_px = 800, key.height_px = 400;
    Link link = link_of(key, camera_at({15, 17, 31}, 123, -45));
    auto expect_near = [](const glm::dvec3& a, const glm::dvec3& b) {
        EXPECT_LT(glm::length(a - b), 1e-12) << a.x << " " << a.y;
    };
    expect_near(link.eye_m, {3, 1, 5});
    expect_near(link.key_from_world * glm::dvec3(1, 0, 0), {0, 0, 1});
    expect_near(link.key_from_world * glm::dvec3(0, 1, 0), {-1, 0, 0});
    expect_near(link.key_from_world * glm::dvec3(0, 0, 1), {0, 1, 0});
    // 7 m along the world's (2, -1, 3) from the novel eye: (29, 10, 52), which the key sees 19 m ahead.
    expect_near(link.eye_m + 7.0 * (link.key_from_world * glm::dvec3(2, -1, 3)), {10, 22, 19});
    EXPECT_NEAR(link.tangents.x, 2, 1e-12);
    EXPECT_NEAR(link.tangents.y, 1, 1e-12);
}

TEST(PoseTrack, GoesOnAlongALine) {
    PoseTrack track;
    for (int frame = 0; frame < 9; ++frame) track.add(camera_at({2.0 * frame, -frame, 100 + 0.5 * frame}, 3.0 * frame, -frame));
    for (double frames : {0.0, 0.5, 1.0, 24.0}) {
        view::Camera ahead = track.predicted(frames);
        glm::dvec3 wanted{2 * (8 + frames), -(8 + frames), 100 + 0.5 * (8 + frames)};
        EXPECT_LT(glm::length(ahead.position_m - wanted), 1e-9);
        EXPECT_NEAR(ahead.heading_deg, 3 * (8 + frames), 1e-9);
        EXPECT_NEAR(ahead.pitch_deg, -(8 + frames), 1e-9);
    }
    EXPECT_NEAR(track.speed_m(), std::sqrt(4 + 1 + 0.25), 1e-12);
    EXPECT_EQ(track.predicted(200).pitch_deg, -90);
}

TEST(PoseTrack, TurnsTheShorterWay) {
    for (double way : {1.0, -1.0}) {
        PoseTrack track;
        for (int frame = -2; frame <= 2; ++frame) track.add(camera_at({0, 0, 0}, std::remainder(180 + way * 4 * frame, 360)));
        EXPECT_NEAR(std::remainder(track.predicted(3).heading_deg - (180 + way * 20), 360), 0, 1e-9);
    }
}

TEST(PoseTrack, StaysWhereItIsIfItIsStillOrNew) {
    PoseTrack track;
    for (int frame = 0; frame < 6; ++frame) {
        track.add(camera_at({5, 6, 7}, 12, 3));
        EXPECT_EQ(track.predicted(100).position_m, glm::dvec3(5, 6, 7));
        EXPECT_EQ(track.predicted(100).heading_deg, 12);
        EXPECT_EQ(track.speed_m(), 0);
    }
    track.forget();
    track.add(camera_at({50, 0, 0}));
    EXPECT_EQ(track.predicted(10).position_m, glm::dvec3(50, 0, 0));
    EXPECT_EQ(track.speed_m(), 0);
}

TEST(PoseTrack, LooksBackFourFrames) {
    PoseTrack track;
    for (int frame = 0; frame < 20; ++frame) track.add(camera_at({frame < 10 ? 0.0 : 3.0 * (frame - 10), 0, 0}));
    EXPECT_NEAR(track.predicted(4).position_m.x, 39, 1e-12);
}

TEST(PoseTrack, DoesNotTakeATeleportForSpeed) {
    PoseTrack track;
    for (int frame = 0; frame < 9; ++frame) track.add(camera_at({2.0 * frame, 0, 0}));
    for (int frame = 0; frame < 4; ++frame) {
        track.add(camera_at({5000 + 2.0 * frame, 900, 0}, 170));
        EXPECT_LT(track.speed_m(), 2.001);
        EXPECT_LT(std::abs(track.predicted(10).position_m.x - (5000 + 2 * frame)), 20.001);
        EXPECT_EQ(track.predicted(10).heading_deg, 170);
    }
    EXPECT_NEAR(track.speed_m(), 2, 1e-9);
    // Starting from rest and speeding up are no teleports for long.
    PoseTrack starting;
    double x_m = 0;
    for (int frame = 0; frame < 40; ++frame) {
        starting.add(camera_at({x_m, 0, 0}));
        x_m += frame < 5 ? 0 : 0.2 * (frame - 4);
    }
    EXPECT_GT(starting.speed_m(), 5);
}

}  // namespace
}  // namespace overlook::lod_sprite
