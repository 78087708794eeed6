#include "runtime/discrete/reprojection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/discrete.h"
#include "runtime/discrete/poses.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::discrete {
namespace {

// Pixels and what the depth buffer holds.
glm::dvec3 shown(const view::Camera& camera, const glm::dvec3& place_m) {
    view::Axes axes = view::axes_of(camera);
    glm::dvec3 from_eye = place_m - camera.position_m;
    double depth_m = glm::dot(axes.forward, from_eye), focal = view::focal_px(camera);
    return {camera.width_px / 2.0 + focal * glm::dot(axes.right, from_eye) / depth_m,
            camera.height_px / 2.0 + focal * glm::dot(axes.up, from_eye) / depth_m, camera.near_m / depth_m};
}

glm::dvec3 moved(const glm::mat4& by, const view::Camera& camera, const glm::dvec3& at) {
    glm::vec4 clip(2 * at.x / camera.width_px - 1, 2 * at.y / camera.height_px - 1, at.z, 1);
    glm::dvec4 there = by * clip;
    return {(there.x / there.w + 1) / 2 * camera.width_px, (there.y / there.w + 1) / 2 * camera.height_px, there.z / there.w};
}

struct Cameras {
    view::Camera old_one, new_one;
    Cameras() {
        old_one.position_m = {1e6, 3, 2}, old_one.heading_deg = 20, old_one.pitch_deg = -5;
        old_one.width_px = 640, old_one.height_px = 480, old_one.near_m = 0.01;
        new_one = old_one;
        new_one.position_m += glm::dvec3(0.4, -0.2, 0.1), new_one.heading_deg = 23, new_one.pitch_deg = -4;
    }
};

TEST(Reprojection, OfWhatStandsIsEquation2) {
    Cameras cameras;
    Reprojection still = reprojection(cameras.old_one, {}, cameras.new_one, {});
    for (double ahead_m : {2.0, 30.0, 5000.0}) {
        glm::dvec3 place_m = cameras.new_one.position_m + ahead_m * glm::dvec3(0.35, 0.9, -0.1);
        glm::dvec3 old_at = shown(cameras.old_one, place_m), new_at = shown(cameras.new_one, place_m);
        glm::dvec3 back = moved(still.old_from_new, cameras.new_one, new_at),
                   forth = moved(still.new_from_old, cameras.old_one, old_at);
        EXPECT_NEAR(back.x, old_at.x, 0.01);
        EXPECT_NEAR(back.y, old_at.y, 0.01);
        EXPECT_NEAR(back.z, old_at.z, 1e-5 * old_at.z);
        EXPECT_NEAR(forth.x, new_at.x, 0.01);
        EXPECT_NEAR(forth.y, new_at.y, 0.01);
    }
    // The sky, infinitely far, follows the turn alone.
    glm::dvec3 sky = moved(still.old_from_new, cameras.new_one, {300, 200, 0});
    glm::dvec3 far_off = moved(still.old_from_new, cameras.new_one, {300, 200, 1e-12});
    EXPECT_NEAR(sky.x, far_off.x, 1e-3);
    EXPECT_NEAR(sky.y, far_off.y, 1e-3);
}

TEST(Reprojection, OfWhatMovesIsByItsOwnTwoPlacements) {
    Cameras cameras;
    scene::Transform before, now;
    before.translation_m = {1e6 + 8, 20, 1}, before.rotation_z_deg = 30, before.scale = 2;
    now.translation_m = {1e6 + 9, 22, 0.5}, now.rotation_z_deg = 75, now.scale = 2.5;
    Placement a = placement_of(before), b = placement_of(now);
    Reprojection own = reprojection(cameras.old_one, a, cameras.new_one, b);
    for (glm::dvec3 part_m : {glm::dvec3(0), glm::dvec3(0.5, -0.3, 0.7), glm::dvec3(-0.2, 0.9, -0.4)}) {
        glm::dvec3 back = moved(own.old_from_new, cameras.new_one, shown(cameras.new_one, b.at(part_m)));
        glm::dvec3 wanted = shown(cameras.old_one, a.at(part_m));
        EXPECT_NEAR(back.x, wanted.x, 0.01);
        EXPECT_NEAR(back.y, wanted.y, 0.01);
        EXPECT_NEAR(back.z, wanted.z, 1e-4 * wanted.z);
    }
}

TEST(Reprojection, OfTheSameTwiceIsNone) {
    Cameras cameras;
    Reprojection same = reprojection(cameras.new_one, {}, cameras.new_one, {});
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            float wanted = column == row ? same.old_from_new[3][3] : 0.0f;
            EXPECT_NEAR(same.old_from_new[column][row], wanted, 1e-6f * same.old_from_new[3][3]);
        }
    }
}

TEST(Extent, HoldsWhatIsSeenOfASphere) {
    Cameras cameras;
    const view::Camera& camera = cameras.new_one;
    view::Axes axes = view::axes_of(camera);
    for (double side : {-1.5, -0.4, 0.0, 0.6, 1.2}) {
        glm::dvec3 middle = 10.0 * axes.forward + 10 * side * axes.right + 3.0 * axes.up;
        Extent extent = extent_of(camera, middle, 2, 0);
        bool is_any_seen = false;
        for (int i = 0; i < 2000; ++i) {
            double z = 1 - (i + 0.5) / 1000, turn = i * 2.399963;
            glm::dvec3 out(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
            glm::dvec3 at = shown(camera, camera.position_m + middle + 2.0 * out);
            if (at.x < 0 || at.y < 0 || at.x >= 640 || at.y >= 480) continue;
            is_any_seen = true;
            EXPECT_TRUE(at.x >= extent.left && at.x <= extent.right && at.y >= extent.bottom && at.y <= extent.top) << side;
            EXPECT_LE(at.z, extent.near_z * 1.0001);
            EXPECT_GE(at.z, extent.far_z * 0.9999);
        }
        EXPECT_EQ(is_any_seen, extent.left < extent.right) << side;
    }
    EXPECT_EQ(extent_of(camera, -9.0 * axes.forward, 2, 0).right, 0);   // behind
    EXPECT_EQ(extent_of(camera, 1.0 * axes.forward, 2, 0).right, 640);  // round the eye
}

// Every square in which a point of the sphere is seen is held, and its rectangle's corners are not.
TEST(Tiles, FollowTheOutlineOfASphere) {
    Cameras cameras;
    const view::Camera& camera = cameras.new_one;
    view::Axes axes = view::axes_of(camera);
    for (double side : {-0.9, -0.3, 0.0, 0.5}) {
        glm::dvec3 middle = 10.0 * axes.forward + 10 * side * axes.right + 1.0 * axes.up;
        Extent extent = extent_of(camera, middle, 2, 1), rectangle = extent;
        rectangle.half_rad = 4;
        Tiles tiles = tiles_of(camera, std::span(&extent, 1)), all = tiles_of(camera, std::span(&rectangle, 1));
        for (int i = 0; i < 20000; ++i) {
            double z = 1 - (i + 0.5) / 10000, turn = i * 2.399963;
            glm::dvec3 out(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
            glm::dvec3 at = shown(camera, camera.position_m + middle + 2.0 * out);
            for (glm::dvec2 by : {glm::dvec2(0), glm::dvec2(0.99, -0.99), glm::dvec2(-0.99, 0.99)}) {  // the margin
                glm::dvec2 px = glm::dvec2(at) + by;
                if (px.x < 0 || px.y < 0 || px.x >= 640 || px.y >= 480) continue;
                size_t tile = size_t(px.y) / Tiles::kSide_px * tiles.columns + size_t(px.x) / Tiles::kSide_px;
                EXPECT_EQ(tiles.entries[tile * Tiles::kMost], 1u) << side << " " << px.x << "," << px.y;
            }
        }
        auto held = [](const Tiles& of) { return std::count(of.entries.begin(), of.entries.end(), 1u); };
        EXPECT_LT(double(held(tiles)), 0.92 * double(held(all))) << side;
    }
}

TEST(Tiles, HoldTheNearestThatMayBeSeenThere) {
    view::Camera camera;
    camera.width_px = 50, camera.height_px = 33;
    std::vector<Extent> extents = {{10, 0, 20, 5, 1, 0}, {}, {0, 0, 50, 33, 1, 0}};
    Tiles tiles = tiles_of(camera, extents);
    EXPECT_EQ(tiles.columns, 4u);
    EXPECT_EQ(tiles.rows, 3u);
    auto entry = [&](uint32_t column, uint32_t row, uint32_t at) {
        return tiles.entries[(row * 4 + column) * Tiles::kMost + at];
    };
    EXPECT_EQ(entry(0, 0, 0), 1u);
    EXPECT_EQ(entry(0, 0, 1), 3u);
    EXPECT_EQ(entry(1, 0, 0), 1u);
    EXPECT_EQ(entry(2, 0, 0), 3u);
    EXPECT_EQ(entry(2, 0, 1), 0u);
    EXPECT_EQ(entry(3, 2, 0), 3u);
    EXPECT_EQ(tiles.dropped_count, 0u);
    extents.resize(30, {0, 0, 1, 1, 1, 0});
    EXPECT_EQ(tiles_of(camera, extents).dropped_count, 2u + 27u - Tiles::kMost);
}

TEST(Poses, TurnAboutTheChainsOwnOriginWhereverItLies) {
    Chain chain = made::windmill_chain();
    chain.origin_m += glm::dvec3(0, 0, 0);
    ASSERT_TRUE(is_animated(chain));
    std::vector<PartPose> poses;
    append_poses(chain, 1, poses);  // a quarter turn about y
    ASSERT_EQ(poses.size(), 2u);
    EXPECT_EQ(poses[0], PartPose{});
    glm::dvec3 rest(0, 0, 1.5), from_origin = rest - chain.origin_m;
    glm::quat turn(poses[1].turn.w, poses[1].turn.x, poses[1].turn.y, poses[1].turn.z);
    glm::dvec3 at = chain.origin_m + glm::dvec3(turn * glm::vec3(from_origin) + glm::vec3(poses[1].move_m));
    EXPECT_NEAR(at.x, 1.5, 1e-5);
    EXPECT_NEAR(at.y, 0, 1e-5);
    EXPECT_NEAR(at.z, 0, 1e-5);
    EXPECT_FALSE(is_animated(made::sphere_chain()));
    for (uint32_t i : {0u, 1u, 77u, 4000000u}) {
        EXPECT_GE(clip_begin_s(i, 4), 0);
        EXPECT_LT(clip_begin_s(i, 4), 4);
    }
    EXPECT_NE(clip_begin_s(1, 4), clip_begin_s(2, 4));
}

}  // namespace
}  // namespace overlook::discrete
