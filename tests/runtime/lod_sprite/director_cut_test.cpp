// What frames promise beside their keys, and what they spend.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "tests/runtime/lod_sprite/director_flight.h"

namespace overlook::lod_sprite {
namespace {

using namespace flown;

// What frames with keys keep, frames without one keep as well: keys may be made of finer triangles than anybody asks of a frame.
TEST(Director, KeepsTheErrorAskedWhileThereIsNoKey) {
    for (double key_error_px : {0.1, 0.5}) {
        Settings settings;
        settings.error_px = 0.1;  // a key of more triangles than a slice
        settings.key_error_px = key_error_px;
        Flight flight(settings);
        view::Camera camera = start_pose();
        terrain::Cut unkeyed;
        ground().refiner.cut_by_pixels(camera, key_error_px, unkeyed, settings.morph);
        Frame first = flight.step(camera);
        ASSERT_TRUE(first.novel.is_fine);
        EXPECT_EQ(first.indices, unkeyed.indices);
        EXPECT_EQ(first.novel.error_p99_px, key_error_px);
        EXPECT_EQ(first.novel.near_triangle_count, 0u);
    }
}

TEST(Director, KeepsNoPromiseThatATexelCannotShow) {
    Settings settings;
    settings.error_px = 0.01, settings.key_error_px = 0.9;
    auto cut_px = [&](uint32_t scale, double texel_share) {
        settings.scale = scale, settings.texel_share = texel_share;
        TerrainGeometry geometry(ground().refiner);
        return Director(geometry, settings).key_cut_px();
    };
    EXPECT_EQ(cut_px(2, 0.25), 0.125);
    EXPECT_EQ(cut_px(1, 0.25), 0.25);
    EXPECT_EQ(cut_px(2, 0), 0.01);
    EXPECT_DOUBLE_EQ(cut_px(1, 1), 0.6);  // room is left below key_error_px
    settings.error_px = 0.5;
    EXPECT_EQ(cut_px(2, 0.25), 0.5);
}

TEST(Director, PutsNearTrianglesFirst) {
    Settings settings;
    Flight flight(settings);
    view::Camera low = start_pose();
    low.pitch_deg = -35;
    uint64_t near = 0, far = 0;
    for (int step = 0; step < 40; ++step) {  // along the ground
        low.position_m.y += 40;
        low.position_m.z = test::height_at_m(ground().terrain, low.position_m.x, low.position_m.y) + 60;
        Frame frame = flight.step(low);
        if (frame.novel.is_fine) continue;
        terrain::Cut cut;
        ground().refiner.cut_by_pixels(frame.camera,
                                       {settings.low_error_px, settings.morph, frame.novel.near_depth_m, settings.error_px,
                                        frame.novel.finer_outside, frame.novel.finer_in},
                                       cut);
        ASSERT_EQ(triangles_of(frame.indices), triangles_of(cut.indices));
        view::Axes axes = view::axes_of(frame.camera);
        for (size_t i = 0; i < frame.indices.size(); i += 3) {
            double farthest_m = 0;
            for (size_t k = i; k < i + 3; ++k) {
                glm::dvec3 away_m = ground().refiner.vertex_m(cut, frame.indices[k]) - frame.camera.position_m;
                farthest_m = std::max(farthest_m, glm::dot(away_m, axes.forward));
            }
            bool is_near = i / 3 < frame.novel.near_triangle_count;
            ASSERT_EQ(farthest_m < frame.novel.near_depth_m, is_near);
            ++(is_near ? near : far);
        }
    }
    EXPECT_GT(near, 100u);
    EXPECT_GT(far, 100u);
}

// What no key looked at is drawn as fine as asked, at once: a camera that turns never waits for a key.
TEST(Director, KeepsTheErrorAskedWhereNoKeyLooked) {
    Flight flight;
    flight.fly(start_pose(), {0, 2, 0}, 0, 40);
    view::Camera camera = start_pose();
    camera.position_m.y += 80;
    uint32_t turned = 0;
    for (int frame = 0; frame < 12; ++frame) {
        camera.heading_deg += 2.8;
        Frame shown = flight.step(camera);
        EXPECT_LE(shown.novel.error_p99_px, 1 + 1e-6) << frame;
        if (shown.novel.is_fine || !shown.novel.finer_outside) continue;
        ++turned;
        terrain::Cut coarse;
        ground().refiner.cut_by_pixels(camera, shown.novel.low_error_px, coarse);
        EXPECT_GT(shown.indices.size(), coarse.indices.size());
    }
    EXPECT_GE(turned, 3u);
}

uint64_t triangles_in(const Frame& frame) {
    return frame.slice_triangles + frame.indices.size() / 3;
}

// Of a steady flight, frames 60 to 160.
std::vector<Frame> cruise(double triangles, double speed = 1) {
    Settings settings;
    settings.error_px = settings.key_error_px = 0.5;
    settings.triangles = triangles;
    Flight flight(settings);
    std::vector<Frame> frames = flight.fly(start_pose(), glm::dvec3(1, 4, 0) * speed, 0.1 * speed, 160);
    frames.erase(frames.begin(), frames.begin() + 60);
    return frames;
}

TEST(Director, SpendsABudgetThatBindsAndNoMore) {
    std::vector<Frame> free = cruise(0);
    uint64_t sum = 0;
    for (const Frame& frame : free) sum += triangles_in(frame);
    double mean = double(sum) / double(free.size());
    for (double share : {0.7, 0.4}) {
        uint64_t keys = 0;
        for (const Frame& frame : cruise(share * mean)) {
            EXPECT_LE(double(triangles_in(frame)), 1.05 * share * mean);
            EXPECT_GE(double(triangles_in(frame)), 0.95 * share * mean);
            keys += frame.ended_key;
        }
        EXPECT_GE(keys, 1u) << share;
    }
}

TEST(Director, LeavesABudgetThatDoesNotBindAlone) {
    std::vector<Frame> free = cruise(0), rich = cruise(1e6);
    for (size_t i = 0; i < free.size(); ++i) ASSERT_EQ(triangles_in(free[i]), triangles_in(rich[i])) << i;
}

TEST(Director, SpendsNothingOnFreshKeysForACameraThatStandsStill) {
    EXPECT_EQ(cruise(500, 0).back().slice_triangles, 0u);
}

}  // namespace
}  // namespace overlook::lod_sprite
