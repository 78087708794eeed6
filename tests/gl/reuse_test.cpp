// Ghosts and losses: what keys could have known, of frames by hand and of drawn ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/gl/fixture.h"
#include "tools/measure/methods.h"
#include "tools/measure/reuse_truth.h"
#include "tools/measure/stability/stage.h"

namespace overlook::measure {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

view::Camera northwards(double x_m, uint32_t side_px) {
    view::Camera camera;
    camera.position_m = {x_m, 0, 0};
    camera.width_px = camera.height_px = side_px;
    camera.fov_y_deg = 90;
    camera.near_m = 1;
    return camera;
}

// A wall 100 m away, seen whole.
Frame wall(const view::Camera& camera) {
    Frame frame{camera.width_px, camera.height_px, {}, {}, {}, camera};
    frame.depth_m.assign(size_t(camera.width_px) * camera.height_px, 100);
    frame.ids.assign(frame.depth_m.size(), kBackground + 1);
    return frame;
}

TEST(SeenByAKey, WhatNothingStandsBefore) {
    view::Camera camera = northwards(0, 16);
    Frame frame = wall(camera);
    frame.depth_m[0] = kNothing;
    view::Camera key = northwards(0, 20);
    std::vector<float> depth_m(400, 100);
    std::vector<uint8_t> seen = seen_by(key, depth_m, frame);
    EXPECT_FALSE(seen[0]);  // no surface
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 255);
    std::fill(depth_m.begin(), depth_m.end(), 50);  // something nearer everywhere
    seen = seen_by(key, depth_m, frame);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 0);
    std::fill(depth_m.begin(), depth_m.begin() + 200, 100);  // not in the upper half
    seen = seen_by(key, depth_m, frame);
    EXPECT_TRUE(seen[5 * 16 + 8]);
    EXPECT_FALSE(seen[11 * 16 + 8]);
}

TEST(SeenByAKey, FromWhereItStandsAndLooks) {
    Frame frame = wall(northwards(0, 16));
    view::Camera beside = northwards(100, 16);  // sees the right half of the frame in its left half
    std::vector<float> depth_m(256, 100);
    std::vector<uint8_t> seen = seen_by(beside, depth_m, frame);
    EXPECT_FALSE(seen[8 * 16 + 6]);
    EXPECT_TRUE(seen[8 * 16 + 10]);
    beside.heading_deg = 180;
    seen = seen_by(beside, depth_m, frame);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 0);
}

// Behind all four texels by more than a part of what they differ by.
TEST(SeenByAKey, SlopesAreNoSteps) {
    view::Camera camera = northwards(0, 16);
    Frame frame = wall(camera);
    std::vector<float> depth_m(256);
    for (size_t i = 0; i < depth_m.size(); ++i) depth_m[i] = float(99.6 - 0.4 * double(i % 2));
    std::vector<uint8_t> seen = seen_by(camera, depth_m, frame);
    EXPECT_FALSE(seen[8 * 16 + 8]);
    for (float& each : depth_m) each += 0.2f;
    seen = seen_by(camera, depth_m, frame);
    EXPECT_TRUE(seen[8 * 16 + 8]);
}

struct Drawn {
    World world;
    std::vector<view::Camera> cameras;

    Drawn() {
        world.terrain = std::make_unique<terrain::Terrain>(test::hilly_terrain(129));
        world.refiner.emplace(*world.terrain);
        EXPECT_TRUE(upload(world));
        view::Camera camera = test::from_south(*world.terrain, 96, 96);
        camera.position_m.y += 300;
        camera.position_m.z *= 0.6;
        for (int i = 0; i < 24; ++i) {
            cameras.push_back(camera);
            camera.position_m.x += 6;
        }
    }
};

struct Flown {
    double ghost_share = 0, loss_share = 0;
    uint32_t frames = 0;
};

Flown flown(Drawn& drawn, const char* method_name) {
    Flown all;
    ReuseTruth truth(drawn.world);
    std::unique_ptr<Method> method = make_method(*parse_method(method_name), drawn.world);
    Result<gl::Target> target = gl::Target::make(96, 96, 1), middle = gl::Target::make(96, 96, 1);
    for (uint32_t frame = 0; frame < drawn.cameras.size(); ++frame) {
        method->decide(drawn.cameras[frame], frame);
        method->draw(*target);
        std::optional<Sources> sources = method->sources(*middle);
        if (!sources) continue;
        ImageRgb8 before = target->read();
        method->draw(*target);
        EXPECT_EQ(target->read().pixels, before.pixels);  // asking changes nothing
        Result<Frame> full = truth.full_geometry(drawn.cameras[frame]);
        Result<Reuse> reuse = truth.reuse(*sources, *full);
        all.ghost_share = std::max(all.ghost_share, reuse->errors.ghost_share);
        all.loss_share = std::max(all.loss_share, reuse->errors.loss_share);
        ++all.frames;
    }
    return all;
}

TEST(Reuse, GhostsAreSeenWhereAKeyIsBelievedWithoutATest) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Drawn drawn;
    const char* stubborn = "lod-sprite@samples=1@near=0@key-error-px=1000";
    Flown tested = flown(drawn, stubborn);
    Flown believed = flown(drawn, "lod-sprite@samples=1@near=0@key-error-px=1000@place-test=0@slab-test=0@outlines=0");
    EXPECT_GT(tested.frames, 10u);
    EXPECT_LT(tested.ghost_share, 0.01);
    EXPECT_GT(believed.ghost_share, 2 * tested.ghost_share + 0.005);
}

TEST(Reuse, ThePapersTrianglesLoseMoreThanPixels) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Drawn drawn;
    Flown pixels = flown(drawn, "lod-sprite@samples=1"), triangles = flown(drawn, "lod-sprite:paper@samples=1@key-error-px=50");
    EXPECT_GT(triangles.frames, 10u);
    EXPECT_GT(triangles.loss_share, pixels.loss_share);
}

TEST(Reuse, NearGeometryIsNeither) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    Drawn drawn;
    ReuseTruth truth(drawn.world);
    Result<Frame> full = truth.full_geometry(drawn.cameras[0]);
    ASSERT_TRUE(full);
    Sources sources{std::vector<uint8_t>(96 * 96, Sources::kNear), {drawn.cameras[0]}};
    Result<Reuse> reuse = truth.reuse(sources, *full);
    EXPECT_EQ(reuse->errors.ghosts_px + reuse->errors.losses_px, 0u);
    EXPECT_EQ(reuse->near_share, 1);
    std::fill(sources.of_pixel.begin(), sources.of_pixel.end(), Sources::kOwn);
    EXPECT_GT(truth.reuse(sources, *full)->errors.loss_share, 0.9);  // the key stands where the frame's camera does
    std::fill(sources.of_pixel.begin(), sources.of_pixel.end(), uint8_t(1));
    EXPECT_LT(truth.reuse(sources, *full)->errors.ghost_share, 0.1);  // its outermost pixels
}

}  // namespace
}  // namespace overlook::measure
