// When keys are made, by whom, and how they take over from one another.
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

// Keys fade in and out by a step a frame, also where one is done while another fades in, unless none at hand serves any longer.
// Of two that may be kept, the one left behind has to give its place to the next; but even there the one in use is never emptied
// (Flight::step sees to that).
TEST(Director, NeverBreaksOffAFadeThatServes) {
    uint32_t made_in_fades = 0;
    for (uint32_t slots : {2u, 3u, 4u}) {
        Settings settings;
        settings.slots = slots;
        settings.fade_frames = 24;
        Flight flight(settings);
        std::map<uint32_t, double> before;
        double fade_before = 0, lost_before = 1;
        for (const Frame& frame : flight.fly(start_pose(), {0, 20, 0}, 0, 240)) {
            made_in_fades += frame.ended_key && fade_before > 0;
            std::map<uint32_t, double> weights;
            for (const NovelUse& use : frame.novel.keys) weights[use.slot] = use.weight;
            bool served = lost_before < 0.003;  // with room to spare for one more frame
            for (auto [slot, weight] : before) {
                if (served && slots > 2 && weights.count(slot) == 0) {
                    EXPECT_LE(weight, 1.0 / settings.fade_frames + 0.002) << slot << " of " << slots << " vanishes";
                }
            }
            for (auto [slot, weight] : weights) {
                bool goes_on = served && frame.novel.rekeyed == Cause::none && before.count(slot) > 0;
                if (goes_on) {
                    EXPECT_LE(std::abs(weight - before.at(slot)), 1.0 / settings.fade_frames + 0.002) << slot;
                }
            }
            if (frame.novel.rekeyed != Cause::none && served) {
                EXPECT_LE(fade_before, 1.5 / settings.fade_frames) << "broken off";
            }
            before = weights;
            fade_before = frame.novel.own_weight;
            lost_before = frame.novel.lost_share;
        }
    }
    EXPECT_GT(made_in_fades, 0u);
}

TEST(Director, HasAKeyWithinFifteenFramesOfTheStart) {
    for (double speed_m : {0.0, 3.0}) {
        Flight flight;
        EXPECT_LE(frames_without_key(flight, start_pose(), {0, speed_m, 0}), 15) << speed_m;
    }
}

TEST(Director, HasAKeyWithinFifteenFramesOfATeleport) {
    for (double speed_m : {0.0, 3.0})
        for (int frames_before : {3, 30, 33, 36, 40, 47}) {
            Flight flight;
            flight.fly(start_pose(), {0, speed_m, 0}, 0, frames_before);
            int teleport = 0;
            for (auto [x, y, heading] : {std::array{1000.0, -1500.0, 150.0}, {6000.0, -9000.0, -60.0}, {3900.0, -6000.0, 0.0}}) {
                view::Camera there = start_pose();
                there.position_m.x = x, there.position_m.y = y, there.heading_deg = heading;
                EXPECT_LE(frames_without_key(flight, there, {0, speed_m, 0}), 15)
                    << "teleport " << teleport << " after " << frames_before << " frames at " << speed_m;
                ++teleport;
            }
        }
}

TEST(Director, AsksForAThreadsKeySoManyFramesLater) {
    Settings settings;
    settings.mode = KeyMode::thread;
    Flight flight(settings);
    std::vector<Frame> frames = flight.fly(start_pose(), {0, 10, 0}, 0.1, 200);
    std::optional<size_t> begun;
    int keys = 0;
    for (size_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].had_work, frames[i].begun || frames[i].ended_key) << i;
        if (frames[i].ended_key) {
            ASSERT_TRUE(begun);
            EXPECT_EQ(i, *begun + kThreadFrames);
            ++keys;
        }
        if (frames[i].begun) begun = i;
    }
    EXPECT_EQ(frames[0].begun.has_value(), true);
    EXPECT_GE(keys, 3);
}

TEST(Director, MakesOneKeyForACameraThatStandsStill) {
    for (KeyMode mode : {KeyMode::sliced, KeyMode::at_once, KeyMode::thread})
        for (double error_px : {0.7, 1.0, 2.0}) {
            Settings settings;
            settings.mode = mode, settings.error_px = error_px;
            Flight flight(settings);
            flight.fly(start_pose(), {0, 0, 0}, 0, 60);
            EXPECT_EQ(flight.director().keys_made(), 1u) << error_px;
        }
}

TEST(Director, DrawsEachTriangleOfAKeyOnce) {
    Flight flight;
    flight.fly(start_pose(), {1, 4, 0}, 0.1, 150);
    terrain::Cut whole;
    int compared = 0;
    for (size_t i = 0; i < flight.drawn.size(); ++i) {
        if (!flight.ended[i]) continue;
        ground().refiner.cut_by_pixels(flight.drawn[i].first, flight.director().key_cut_px(), whole);
        EXPECT_EQ(flight.drawn[i].second, triangles_of(whole.indices)) << "key " << i;
        ++compared;
    }
    EXPECT_GE(compared, 3);
}

TEST(Director, SpreadsAKeyOverManyFrames) {
    Flight flight;
    std::vector<Frame> frames = flight.fly(start_pose(), {0, 4, 0}, 0, 200);
    uint64_t keys = 0, sliced_frames = 0;
    size_t greatest_key = 0;
    for (auto& [camera, triangles] : flight.drawn) greatest_key = std::max(greatest_key, triangles.size());
    for (size_t i = 20; i < frames.size(); ++i) {
        EXPECT_LE(frames[i].slice_triangles, greatest_key / 4) << "frame " << i;
        sliced_frames += frames[i].had_work;
        keys += frames[i].ended_key;
    }
    EXPECT_GE(keys, 2u);
    EXPECT_GE(sliced_frames, 6 * keys);
}

TEST(Director, MakesAKeyInTheFrameThatNeedsItIfAtOnce) {
    Settings settings;
    settings.mode = KeyMode::at_once, settings.key_error_px = 1.3;
    Flight flight(settings);
    std::vector<Frame> frames = flight.fly(start_pose(), {0, 10, 0}, 0, 100);
    int keys = 0;
    for (const Frame& frame : frames) {
        EXPECT_FALSE(frame.novel.is_fine);
        EXPECT_LE(frame.novel.error_p99_px, 1.3 * 1.05);
        EXPECT_EQ(frame.had_work, frame.ended_key);
        EXPECT_EQ(frame.novel.rekeyed != Cause::none, frame.had_work);
        if (frame.begun) {
            EXPECT_EQ(frame.begun->position_m, frame.camera.position_m);
        }
        keys += frame.had_work;
    }
    EXPECT_EQ(frames[0].novel.rekeyed, Cause::first);
    EXPECT_GE(keys, 2);
    EXPECT_LE(keys, 50);
}

TEST(Director, ReusesKeptKeysToAndFro) {
    Settings settings;
    settings.mode = KeyMode::at_once, settings.key_error_px = 1.3, settings.slots = 8;
    Flight flight(settings);
    view::Camera from = start_pose(), to = start_pose();
    auto there_and_back = [&] {
        flight.fly(from, {0, 10, 0}, 0, 60);
        to.position_m.y = from.position_m.y + 600;
        flight.fly(to, {0, -10, 0}, 0, 60);
    };
    there_and_back();
    uint64_t made = flight.director().keys_made();
    EXPECT_GE(made, 2u);
    EXPECT_LE(made, 8u);
    there_and_back(), there_and_back();
    EXPECT_EQ(flight.director().keys_made(), made);
    flight.director().forget();
    EXPECT_EQ(flight.step(from).novel.rekeyed, Cause::first);
    EXPECT_EQ(flight.director().keys_made(), made + 1);
}

TEST(Director, ForgetsItsKeys) {
    Flight flight;
    flight.fly(start_pose(), {0, 3, 0}, 0, 40);
    EXPECT_FALSE(flight.step(start_pose()).novel.is_fine);
    flight.director().forget();
    EXPECT_TRUE(flight.step(start_pose()).novel.is_fine);
    EXPECT_LE(frames_without_key(flight, start_pose(), {0, 3, 0}), 15);
}

TEST(Director, PlansTheSameForTheSameFlight) {
    std::array<std::vector<Frame>, 2> twice;
    for (std::vector<Frame>& frames : twice) frames = Flight().fly(start_pose(), {2, 5, -0.5}, 0.2, 120);
    for (size_t i = 0; i < twice[0].size(); ++i) {
        const Frame &a = twice[0][i], &b = twice[1][i];
        ASSERT_EQ(a.indices, b.indices);
        ASSERT_EQ(a.slice_triangles, b.slice_triangles);
        ASSERT_EQ(a.novel.near_depth_m, b.novel.near_depth_m);
        ASSERT_EQ(a.novel.error_p99_px, b.novel.error_p99_px);
        ASSERT_EQ(a.novel.keys.size(), b.novel.keys.size());
        for (size_t k = 0; k < a.novel.keys.size(); ++k) ASSERT_EQ(a.novel.keys[k].weight, b.novel.keys[k].weight);
    }
}

TEST(Director, FadesFromKeyToKey) {
    Settings settings;
    settings.fade_frames = 4;
    Flight flight(settings);
    std::vector<Frame> frames = flight.fly(start_pose(), {0, 5, 0}, 0, 200);
    int fading = 0, faded = 0;
    uint32_t slot = ~0u;
    double before = 0;
    for (const Frame& frame : frames) {
        if (frame.novel.is_fine) continue;
        double sum = 0;
        for (const NovelUse& use : frame.novel.keys) sum += use.weight;
        EXPECT_NEAR(sum, 1, 0.002);
        const NovelUse& now = frame.novel.keys[0];
        if (now.slot == slot) {
            EXPECT_GE(now.weight, before);
        }
        bool is_whole = now.weight == 1;
        faded += is_whole && before < 1 && slot == now.slot;
        fading += !is_whole && frame.novel.keys.size() == 2 && now.weight > 0.05;
        slot = now.slot, before = now.weight;
    }
    EXPECT_GE(faded, 2);
    EXPECT_GE(fading, 2 * 3);
}

// The first key takes over from geometry as fine as asked, which stays until it has.
TEST(Director, FadesTheFirstKeyInOverFineGeometry) {
    Settings settings;
    settings.fade_frames = 4;
    settings.mode = KeyMode::thread;  // whose key takes over in a later frame
    Flight flight(settings);
    std::vector<double> weights;
    for (const Frame& frame : flight.fly(start_pose(), {0, 0, 0}, 0, 16)) {
        if (frame.novel.is_fine) continue;
        weights.push_back(frame.novel.own_weight);
        terrain::Cut fine;
        ground().refiner.cut_by_pixels(frame.camera, settings.error_px, fine);
        EXPECT_EQ(triangles_of(frame.indices) == triangles_of(fine.indices), frame.novel.own_weight > 0) << weights.size();
    }
    ASSERT_GE(weights.size(), 6u);
    weights.resize(6);
    EXPECT_EQ(weights, (std::vector<double>{1, 0.75, 0.5, 0.25, 0, 0}));
}

}  // namespace
}  // namespace overlook::lod_sprite
