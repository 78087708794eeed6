// One thing's change shared out between even and odd frames.
#include "runtime/discrete/split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/discrete/director.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::discrete {
namespace {

constexpr double kStep_s = 1.0 / 60;

view::Camera camera_at(double distance_m) {
    view::Camera camera;
    camera.position_m = {0, -distance_m, 0};
    camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.01;
    return camera;
}

// A triangle with a corner on a side is drawn there, whatever the plane.
TEST(Split, LeavesNothingOutOfASide) {
    Chain chain = made::sphere_chain(16, 2);
    ChainFacts facts = facts_of(chain);
    Placement placement;
    placement.translation_m = {3, 1, -2}, placement.cosine = 0.6, placement.sine = 0.8, placement.scale = 1.5;
    for (int i = 0; i < 60; ++i) {
        double turn = 2.399963 * i, z = 1 - (i + 0.5) / 30;
        glm::dvec3 out(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
        glm::dvec3 eye_m = placement.at(6.0 * out), way_m(std::cos(3 * turn), 0.3, std::sin(turn));
        std::optional<Split> split =
            split_of(facts.levels[0].bunches, facts.levels[1].bunches, placement, {0, 0, 0}, 1, eye_m, way_m);
        ASSERT_TRUE(split);
        glm::dvec3 normal = turn_to_eye(*split, placement, eye_m);
        EXPECT_NEAR(glm::length(normal), 1, 1e-9);
        EXPECT_NEAR(glm::dot(normal, placement.at(split->anchor_m) - eye_m), 0, 1e-6);
        for (const Level& level : chain.levels) {
            const std::vector<Bunch>& bunches = facts.levels[size_t(&level - chain.levels.data())].bunches;
            for (bool is_along : {true, false}) {
                std::vector<TriangleRun> runs;
                glm::dvec3 inwards = is_along ? normal : -normal;
                uint64_t count = append_seen(bunches, placement, eye_m, {&inwards, 1}, runs);
                EXPECT_LT(count, level.triangle_count());
                EXPECT_EQ(count, seen_count(bunches, placement, eye_m, {&inwards, 1}));
                for (uint32_t k = 0; k < level.indices.size(); ++k) {
                    glm::dvec3 from_eye_m = placement.at(position_m(chain, level.vertices[level.indices[k]])) - eye_m;
                    if ((is_along ? 1 : -1) * glm::dot(normal, from_eye_m) <= 0) continue;
                    EXPECT_TRUE(std::any_of(
                        runs.begin(), runs.end(),
                        [&](const TriangleRun& run) { return k >= run.first_index && k < run.first_index + run.index_count; }))
                        << i << " " << k;
                }
            }
        }
        EXPECT_FALSE(
            split_of(facts.levels[0].bunches, facts.levels[1].bunches, placement, {0, 0, 0}, 1, placement.at(1.1 * out), way_m))
            << "too near";
    }
}

// Of something large that the picture's sides cut only bunches are drawn that may be seen, and all of what is in the picture.
TEST(Director, LeavesOutWhatLiesBesideThePicture) {
    Chain chain = made::sphere_chain(64);
    std::vector<Placement> one(1);
    one[0].translation_m = {1.5, 2, -0.5}, one[0].cosine = 0.8, one[0].sine = 0.6;
    for (Variant variant : {Variant::hard, Variant::fsi, Variant::blend}) {
        FrameOptions options = defaults_of(variant);
        options.select.error_px = 1e-3;
        Director director(facts_of(chain), one, options);
        for (double heading_deg : {-20.0, -5.0, 50.0, 60.0, 70.0}) {
            view::Camera camera = camera_at(2);
            camera.heading_deg = heading_deg;
            director.decide(camera, kStep_s);
            const FrameList& frame = director.frame();
            ASSERT_EQ(frame.items.size(), 1u);
            const Item& item = frame.items[0];
            ASSERT_EQ(item.level, 0u);
            EXPECT_GT(item.run_count, 0u) << heading_deg;
            EXPECT_LT(frame.triangle_count, chain.levels[0].triangle_count()) << heading_deg;
            std::vector<bool> is_drawn(chain.levels[0].indices.size());
            for (const TriangleRun& run : frame.runs) std::fill_n(is_drawn.begin() + run.first_index, run.index_count, true);
            EXPECT_EQ(uint64_t(std::count(is_drawn.begin(), is_drawn.end(), true)), 3 * frame.triangle_count);
            std::array<glm::dvec3, 4> sides = view::sides_of(camera);
            for (size_t k = 0; k < is_drawn.size(); ++k) {
                const Vertex& corner = chain.levels[0].vertices[chain.levels[0].indices[k]];
                glm::dvec3 from_eye_m = one[0].at(position_m(chain, corner)) - camera.position_m;
                bool is_inside = std::all_of(sides.begin(), sides.end(),
                                             [&](const glm::dvec3& inwards) { return glm::dot(inwards, from_eye_m) >= 0; });
                EXPECT_TRUE(is_drawn[k] || !is_inside) << heading_deg << " " << k;
            }
        }
    }
}

// One big thing alone: what changes is divided, so that both frames take half of each level.
TEST(Director, DividesABigThingBetweenFrames) {
    std::vector<Placement> one(1);
    for (glm::dvec3 way_m : {glm::dvec3(0, 0.1, 0), glm::dvec3(0.05, 0.09, 0.01), glm::dvec3(-0.03, 0.08, 0.04)}) {
        for (bool divides : {true, false}) {
            FrameOptions options = defaults_of(Variant::fsi);
            options.remedies.splits_things = divides;
            options.select.error_px = 0.1;
            Director director(facts_of(made::sphere_chain(64)), one, options);
            double worst = 0;
            uint64_t before = 0, compared = 0;
            for (int frame = 0; frame < 700; ++frame) {
                view::Camera camera = camera_at(90);
                camera.position_m += double(frame) * way_m;
                camera.heading_deg = -std::atan2(camera.position_m.x, -camera.position_m.y) * 180 / 3.14159265358979;
                director.decide(camera, kStep_s);
                bool changes = !director.frame().fading.empty();
                uint64_t now = changes ? director.frame().triangle_count : 0;
                if (before > 0 && now > 0) {
                    worst = std::max(worst, std::abs(double(now) - double(before)) / double(std::max(now, before)));
                    ++compared;
                }
                before = now;
            }
            EXPECT_GT(compared, 12u);
            if (divides)
                EXPECT_LE(worst, 0.02) << way_m.x;
            else
                EXPECT_GT(worst, 0.5);
        }
    }
}

}  // namespace
}  // namespace overlook::discrete
