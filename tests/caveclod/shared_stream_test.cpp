// Several meshes and cameras of one stream: room goes where the picture lacks most, every time alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/caveclod/drawn_faces.h"
#include "tests/caveclod/streams.h"

namespace overlook::caveclod {
namespace {

using flights::camera_at;
using flights::flown;
using flights::kFrame_s;
using flights::plain;
using streams::Cameras;
using streams::hills;
using streams::kMuch;
using streams::opened;
using streams::sphere;
using synthetic::applied;
using synthetic::buffers;
using synthetic::drawn;
using synthetic::expected;
using synthetic::is_closed;

TEST(SharedMeshStream, IsTheSameEveryTime) {
    auto run = [](uint32_t latency) {
        auto stream = opened({&hills(), &sphere()}, {3 << 20, 128 << 10, 2, latency});
        Cameras first(*stream, 0, 1), second(*stream, 1, 1);
        Settings settings = plain();
        settings.glide_s = 0.25;
        std::vector<uint32_t> all;
        for (int frame = 0; frame < 40; ++frame) {
            view::Camera camera = flown(0.05 * frame), other = camera_at(0, -60 + frame, 0, 0, 0);
            stream->begin_frame();
            first.refine(std::span(&camera, 1), settings), second.refine(std::span(&other, 1), settings);
            stream->end_frame();
            for (const Refinement* one : {&first[0], &second[0]}) {
                std::vector<uint32_t> drawn = buffers(*one);
                all.insert(all.end(), drawn.begin(), drawn.end());
            }
        }
        return all;
    };
    std::vector<uint32_t> first = run(2);
    EXPECT_TRUE(run(2) == first);
    EXPECT_FALSE(run(5) == first);
}

// One after the other comes near: room goes from the one that is left behind to the one that is seen, without a pop: what stands
// on a block that goes collapses in its own time.
TEST(SharedMeshStream, RoomGoesToTheMeshThatLacksMost) {
    auto stream = opened({&hills(), &sphere()}, {9 << 20, 1 << 20, 1, 1});
    Cameras first(*stream, 0, 1), second(*stream, 1, 1);
    Settings settings = plain();
    settings.error_px = 0.3, settings.glide_s = 0.1, settings.most_operations = 400;
    auto fly = [&](const view::Camera& of_first, const view::Camera& of_second) {
        for (int frame = 0; frame < 200; ++frame) {
            for (const Error& fault : stream->begin_frame()) ADD_FAILURE() << fault.message;
            first.refine(std::span(&of_first, 1), settings), second.refine(std::span(&of_second, 1), settings);
            EXPECT_LE(first.report().collapse_count + first.report().split_count, 400u);
            stream->end_frame();
            const stream::Counts& counts = stream->counts();
            EXPECT_LE(counts.resident_bytes + counts.on_the_way_bytes, uint64_t(9) << 20);
        }
        return std::array{stream->resident_block_count(0), stream->resident_block_count(1)};
    };
    view::Camera near_hills = flown(0), near_sphere = camera_at(0, -16, 0, 0, 0);
    view::Camera at_hills_far = camera_at(32, -2000, 100, 0, 0), at_sphere_far = camera_at(0, -2000, 0, 0, 0);
    std::array before = fly(near_hills, at_sphere_far), after = fly(at_hills_far, near_sphere);
    EXPECT_GT(before[0], after[0]);
    EXPECT_LT(before[1], after[1]);
    EXPECT_GT(stream->counts().dropped_count, 0u);
    EXPECT_EQ(drawn(first[0]), expected(hills().hierarchy, first[0]));
    EXPECT_EQ(fly(near_hills, at_sphere_far), before);
    EXPECT_EQ(drawn(second[0]), expected(sphere().hierarchy, second[0]));
}

// Both near, and room for one: the one that lacks most has it, and keeps it.
TEST(SharedMeshStream, WhatIsSeenGivesWayOnlyToWhatLacksMuchMore) {
    auto stream = opened({&hills(), &sphere()}, {9 << 20, 1 << 20, 1, 1});
    Cameras first(*stream, 0, 1), second(*stream, 1, 1);
    Settings settings = plain();
    settings.error_px = 0.05;
    view::Camera at_hills = camera_at(32, -250, 40, 0, -8), at_sphere = camera_at(0, -3000, 0, 0, 0);
    uint64_t dropped = 0;
    for (int frame = 0; frame < 300; ++frame) {
        if (frame == 100) at_sphere = camera_at(0, -13, 0, 0, 0);  // after the hills have filled all room
        if (frame == 250) dropped = stream->counts().dropped_count;
        stream->begin_frame();
        first.refine(std::span(&at_hills, 1), settings), second.refine(std::span(&at_sphere, 1), settings);
        stream->end_frame();
    }
    EXPECT_GT(dropped, 0u);
    EXPECT_EQ(stream->counts().dropped_count, dropped);  // nothing goes to and fro
}

TEST(SharedMeshStream, IsSharedByManyCameras) {
    auto stream = opened(hills(), kMuch, std::nullopt);
    constexpr size_t kCameras = 4;
    Cameras cameras(*stream, 0, kCameras);
    Settings settings = plain();
    settings.glide_s = 0.25, settings.error_px = 1;
    for (int frame = 0; frame < 60 || !stream->is_settled(); ++frame) {
        stream->begin_frame();
        std::vector<view::Camera> at;
        for (size_t k = 0; k < kCameras; ++k) at.push_back(flown(0.05 * std::min(frame, 60) + 1.5 * double(k)));
        cameras.refine(at, settings);
        stream->end_frame();
    }
    EXPECT_EQ(stream->resident_block_count(0), 5u);
    for (size_t k = 0; k < kCameras; ++k) EXPECT_TRUE(is_closed(hills().hierarchy, applied(hills().hierarchy, cameras[k]))) << k;
}

}  // namespace
}  // namespace overlook::caveclod
