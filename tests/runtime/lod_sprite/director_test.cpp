#include "runtime/lod_sprite/director.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "runtime/lod_sprite/on_terrain.h"
#include "tests/runtime/lod_sprite/sprite_fixture.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::lod_sprite {
namespace {

using Triangles = std::multiset<std::array<uint32_t, 3>>;

// What a frame was, kept.
struct Frame {
    view::Camera camera;
    Novel novel;
    std::vector<uint32_t> indices;  // of the coarse cut
    uint64_t slice_triangles = 0;
    bool had_work = false, ended_key = false;
    std::optional<view::Camera> begun;
};

struct Ground {
    terrain::Terrain terrain = *terrain::bake(overlook::test::make_hills(257, 257, 4), {}, [](double) {});
    terrain::Refiner refiner{terrain};
};
const Ground& ground() {
    static const Ground kGround;
    return kGround;
}

// Above the hills, looking over them.
view::Camera start_pose() {
    view::Camera camera;
    camera.position_m = {3800, -8500, 2000};
    camera.pitch_deg = -15;
    camera.width_px = 320, camera.height_px = 180;
    return camera;
}

constexpr uint64_t kThreadTriangles = 1234;  // of keys that a thread is said to have drawn

// Carries out what a director plans, with a ray marcher for a renderer; sees to it that plans can be carried out.
class Flight {
  public:
    explicit Flight(const Settings& settings = {}) : director_(geometry_, settings) {}

    Frame step(const view::Camera& camera) {
        Frame frame;
        frame.camera = camera;
        while (std::optional<KeyWork> work = director_.key_work(camera)) {
            EXPECT_FALSE(frame.had_work && !frame.ended_key) << "two slices of a key in a frame";
            carry_out(*work, frame);
        }
        EXPECT_EQ(director_.key_triangles(), frame.slice_triangles);
        frame.novel = director_.novel();
        frame.indices = geometry_.coarse().indices;
        EXPECT_EQ(frame.novel.cut.triangle_count, geometry_.coarse().triangle_count());
        for (const NovelUse& use : frame.novel.keys) EXPECT_TRUE(whole_.count(use.slot)) << "a key that is not whole is used";
        EXPECT_EQ(frame.novel.is_fine, frame.novel.keys.empty());
        return frame;
    }
    std::vector<Frame> fly(view::Camera camera, const glm::dvec3& step_m, double turn_deg, int frames) {
        std::vector<Frame> flown;
        for (int i = 0; i < frames; ++i) {
            flown.push_back(step(camera));
            camera.position_m += step_m;
            camera.heading_deg += turn_deg;
        }
        return flown;
    }
    Director& director() { return director_; }

    // Of every key begun: its camera, and what was drawn into it.
    std::vector<std::pair<view::Camera, Triangles>> drawn;
    std::vector<bool> ended;

  private:
    void carry_out(const KeyWork& work, Frame& frame) {
        frame.had_work = true;
        if (work.begin != nullptr) {
            frame.begun = *work.begin;
            whole_.erase(work.slot);
            camera_of_[work.slot] = *work.begin;
            place_of_[work.slot] = drawn.size();
            drawn.push_back({*work.begin, {}});
            ended.push_back(false);
        }
        if (work.slice) add_slice(work, frame);
        if (!work.is_last) return;
        frame.ended_key = true;
        ended[place_of_.at(work.slot)] = true;
        whole_.insert(work.slot);
        director_.key_done(test::seen_depths(ground().terrain, camera_of_.at(work.slot), 48), kThreadTriangles);
        if (!work.slice) frame.slice_triangles = kThreadTriangles;
    }
    void add_slice(const KeyWork& work, Frame& frame) {
        const std::vector<uint32_t>& indices = geometry_.slice().indices;
        EXPECT_EQ(3 * work.slice->triangle_count, indices.size());
        frame.slice_triangles += work.slice->triangle_count;
        Triangles& into = drawn[place_of_.at(work.slot)].second;
        for (size_t i = 0; i < indices.size(); i += 3) {
            std::array<uint32_t, 3> t{indices[i], indices[i + 1], indices[i + 2]};
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
            into.insert(t);
        }
    }

    TerrainGeometry geometry_{ground().refiner};
    Director director_;
    std::set<uint32_t> whole_;
    std::map<uint32_t, view::Camera> camera_of_;
    std::map<uint32_t, size_t> place_of_;
};

Triangles triangles_of(const std::vector<uint32_t>& indices) {
    Triangles triangles;
    for (size_t i = 0; i < indices.size(); i += 3) {
        std::array<uint32_t, 3> t{indices[i], indices[i + 1], indices[i + 2]};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        triangles.insert(t);
    }
    return triangles;
}

// Frames until one is shown from keys within the settings' limit.
int frames_without_key(Flight& flight, view::Camera camera, const glm::dvec3& step_m) {
    for (int frame = 0; frame < 100; ++frame) {
        Frame shown = flight.step(camera);
        if (!shown.novel.is_fine && shown.novel.error_p99_px <= flight.director().settings().key_error_px * 1.5) return frame;
        camera.position_m += step_m;
    }
    return 100;
}

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
