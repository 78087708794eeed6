#include "runtime/discrete/select.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/discrete/visibility.h"
#include "tests/runtime/discrete/chains.h"

namespace overlook::discrete {
namespace {

view::Camera camera_at(double distance_m) {
    view::Camera camera;  // looks north
    camera.position_m = {0, -distance_m, 0};
    camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.01;
    return camera;
}

// Where a place is in the picture, pixels from its middle.
glm::dvec2 shown(const view::Camera& camera, const glm::dvec3& place_m) {
    view::Axes axes = view::axes_of(camera);
    glm::dvec3 from_eye = place_m - camera.position_m;
    return view::focal_px(camera) * glm::dvec2(glm::dot(axes.right, from_eye), glm::dot(axes.up, from_eye)) /
           glm::dot(axes.forward, from_eye);
}

TEST(Placement, IsTheScenesTransform) {
    Placement placed = placement_of({{1, 2, 3}, 90, 2});
    glm::dvec3 at = placed.at({1, 0, 5});
    EXPECT_NEAR(at.x, 1, 1e-12);
    EXPECT_NEAR(at.y, 4, 1e-12);
    EXPECT_NEAR(at.z, 13, 1e-12);
}

TEST(ChainFacts, HoldLostAreaAsADisplacement) {
    Chain chain = made::empty_chain(glm::dvec3(-1), 2);
    Level level;
    made::add_quad(chain, level, {glm::dvec3{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, {255, 255, 255, 255});
    made::end_level(chain, level, 0);
    made::end_level(chain, level, 0.25, 0.5);
    ChainFacts facts = facts_of(chain);
    EXPECT_EQ(facts.levels[0].area_error_m, 0);
    EXPECT_NEAR(facts.levels[1].area_error_m, 0.5 * 4 / (4 * std::numbers::pi * chain.radius_m), 1e-4);
    EXPECT_EQ(facts.levels[1].error_m, 0.25);
    EXPECT_EQ(facts.levels[1].triangle_count, 2u);
}

// The promise: whatever lies as far from level 0 as the level says, anywhere in the frame, is displaced by no more pixels.
TEST(NearPlane, IsByTheLeastThing) {
    std::vector<Placement> placements(3);
    placements[1].scale = 0.25;
    EXPECT_DOUBLE_EQ(near_plane_m(8, placements), 2e-5);
    placements[1].scale = 0;
    EXPECT_DOUBLE_EQ(near_plane_m(8, placements), 1e-11);
    placements[1].scale = 1;
    EXPECT_DOUBLE_EQ(near_plane_m(1e9, placements), 0.5);
}

TEST(Selector, KeepsThePromiseAnywhereInTheFrame) {
    ChainFacts facts = facts_of(made::sphere_chain());
    SelectSettings settings;
    settings.error_px = 2;
    for (double side : {0.0, 0.5, 1.0}) {
        for (double distance_m : {5.0, 20.0, 90.0}) {
            view::Camera camera = camera_at(distance_m);
            double focal = view::focal_px(camera);
            Placement placed;
            placed.translation_m = {side * distance_m * 320 / focal, 0, side * distance_m * 240 / focal};
            placed.scale = 1.5;
            Selector selector(facts, settings, camera);
            uint32_t level = selector.wanted(placed);
            double error_m = facts.levels[level].error_m * placed.scale;
            EXPECT_LE(selector.error_px(placed, level), settings.error_px);
            for (double turn = 0; turn < 6.28; turn += 0.3) {
                glm::dvec3 out(std::cos(turn), -0.4, std::sin(turn));
                glm::dvec3 on = placed.at(glm::normalize(out)),
                           off = on + error_m * glm::dvec3(std::cos(turn), 0, std::sin(turn));
                glm::dvec2 at = shown(camera, on);
                if (std::abs(at.x) > 320 || std::abs(at.y) > 240) continue;
                EXPECT_LE(glm::distance(at, shown(camera, off)), settings.error_px) << side << " " << distance_m;
            }
            if (level + 1 < facts.levels.size()) {
                EXPECT_GT(selector.strain(placed, level + 1), 1);  // and is no finer than it need be
            }
        }
    }
}

TEST(Selector, ChoosesEveryLevelSomewhereAndCoarserFartherAway) {
    ChainFacts facts = facts_of(made::sphere_chain());
    for (Criterion criterion : {Criterion::error, Criterion::size, Criterion::distance, Criterion::importance}) {
        SelectSettings settings;
        settings.criterion = criterion;
        settings.distance_m = 10;
        uint32_t last = 0;
        for (double distance_m = 2; distance_m < 2000; distance_m *= 1.05) {
            uint32_t level = Selector(facts, settings, camera_at(distance_m)).wanted(Placement{});
            EXPECT_GE(level, last);
            EXPECT_LE(level, last + 1);
            last = level;
        }
        EXPECT_EQ(last, 3u) << int(criterion);
    }
}

TEST(Selector, TakesDistancesAndSizesAsTheyAreSaid) {
    ChainFacts facts = facts_of(made::sphere_chain());
    SelectSettings settings;
    settings.criterion = Criterion::distance, settings.distance_m = 10;
    auto level = [&](double distance_m) { return Selector(facts, settings, camera_at(distance_m)).wanted(Placement{}); };
    EXPECT_EQ(level(9.99), 0u);
    EXPECT_EQ(level(10.01), 1u);
    EXPECT_EQ(level(19.99), 1u);
    EXPECT_EQ(level(20.01), 2u);
    settings.criterion = Criterion::size, settings.size_px = 100;
    double at_100_px = 2 * view::focal_px(camera_at(1)) / 100;
    EXPECT_EQ(level(0.999 * at_100_px), 0u);
    EXPECT_EQ(level(1.001 * at_100_px), 1u);
    EXPECT_EQ(level(2.002 * at_100_px), 2u);
}

TEST(Selector, AllowsMoreTowardsTheBorderByImportance) {
    ChainFacts facts = facts_of(made::sphere_chain());
    SelectSettings by_error, by_importance;
    by_importance.criterion = Criterion::importance;
    view::Camera camera = camera_at(60);
    Placement middle, border;
    border.translation_m = {30, 0, 20};
    EXPECT_DOUBLE_EQ(Selector(facts, by_importance, camera).strain(middle, 2),
                     Selector(facts, by_error, camera).strain(middle, 2));
    EXPECT_LT(Selector(facts, by_importance, camera).strain(border, 2),
              0.5 * Selector(facts, by_error, camera).strain(border, 2));
}

TEST(Selector, CountsLostAreaToo) {
    ChainFacts facts = facts_of(made::sphere_chain());
    facts.levels[1].error_m = 0, facts.levels[1].area_error_m = 0.5;
    SelectSettings settings;
    view::Camera camera = camera_at(20);
    EXPECT_GT(Selector(facts, settings, camera).strain(Placement{}, 1), 1);
    settings.area_weight = 0;
    EXPECT_EQ(Selector(facts, settings, camera).strain(Placement{}, 1), 0);
}

// A jitter of 1 % at any distance settles at once.
TEST(Selector, ChangesNothingUnderJitter) {
    ChainFacts facts = facts_of(made::sphere_chain());
    SelectSettings settings;
    for (double distance_m = 3; distance_m < 1000; distance_m *= 1.01) {
        uint32_t level = Selector(facts, settings, camera_at(distance_m)).wanted(Placement{});
        level = Selector(facts, settings, camera_at(distance_m * 0.99)).wanted(Placement{}, level);
        for (int i = 0; i < 8; ++i) {
            double jittered_m = distance_m * (i % 2 == 0 ? 1.01 : 0.99);
            ASSERT_EQ(Selector(facts, settings, camera_at(jittered_m)).wanted(Placement{}, level), level) << distance_m;
        }
    }
}

TEST(Selector, LeavesOutOnlyWhatCannotBeSeen) {
    ChainFacts facts = facts_of(made::sphere_chain());
    view::Camera camera = camera_at(10);
    Selector selector(facts, {}, camera);
    double edge_m = 10 * 320 / view::focal_px(camera);
    auto at = [](double x, double y, double z) {
        Placement placed;
        placed.translation_m = {x, y, z};
        return placed;
    };
    EXPECT_TRUE(selector.is_in_view(at(0, 0, 0)));
    EXPECT_TRUE(selector.is_in_view(at(edge_m + 0.5, 0, 0)));
    EXPECT_FALSE(selector.is_in_view(at(edge_m + 3, 0, 0)));
    EXPECT_FALSE(selector.is_in_view(at(-edge_m - 3, 0, 0)));
    EXPECT_TRUE(selector.is_in_view(at(0, -10.5, 0)));
    EXPECT_FALSE(selector.is_in_view(at(0, -12, 0)));
    EXPECT_FALSE(selector.is_in_view(at(0, 0, 9)));
}

TEST(Visibility, OfNoiseIsEvenlySpread) {
    Visibility noise = uniform_noise(2);
    std::array<int, 256> count{};
    for (uint8_t value : noise.values) ++count[value];
    for (int one : count) EXPECT_EQ(one, 16);
    EXPECT_EQ(uniform_noise(2), noise);
    double row = 0;
    for (uint32_t i = 0; i < kNoiseSide; ++i) row += noise.values[i];
    EXPECT_NEAR(row / kNoiseSide, 127.5, 30);  // no ramp
}

// Section 3.3: (x + z, y + z), repeated.
TEST(Visibility, IsLookedUpAsThePaperDoes) {
    Visibility noise = uniform_noise(2);
    auto at = [&](double x, double y, double z) { return visibility_at(noise, {x, y, z}, {x, y, z}); };
    for (double shift : {0.0, 0.37, 1.11}) {
        EXPECT_EQ(at(0.3 + shift, 0.4 + shift, 0.5), at(0.3, 0.4, 0.5 + shift));
        EXPECT_EQ(at(0.3 + 2, 0.4 - 4, shift), at(0.3, 0.4, shift));
        EXPECT_EQ(at(0.3, 0.4, shift),
                  noise.values[size_t((0.4 + shift) / 2 * 64) % 64 * 64 + size_t((0.3 + shift) / 2 * 64) % 64] / 255.0);
    }
    EXPECT_EQ(visibility_at(noise, {0.6, 0.8, 0.2}, {}, 2), visibility_at(noise, {0.3, 0.4, 0.1}, {}));
}

TEST(Visibility, OfAVolumeLiesOverItsBoxAndGoesOnAtItsBorder) {
    Visibility volume;
    volume.lookup = Visibility::Lookup::volume;
    volume.width = 2, volume.height = 1, volume.depth = 3, volume.period_m = 6;
    volume.values = {0, 51, 102, 153, 204, 255};
    auto at = [&](double x, double y, double z) { return visibility_at(volume, {100, 100, 100}, {x, y, z}); };
    EXPECT_EQ(at(1, 5, 1), 0);
    EXPECT_EQ(at(4, 0, 1), 0.2);
    EXPECT_EQ(at(4, 0, 5), 1);
    EXPECT_EQ(at(-9, 99, -9), 0);
    EXPECT_EQ(at(99, 0, 99), 1);
}

TEST(Visibility, OfAChainIsOneForEveryChange) {
    Chain chain = made::sphere_chain();
    EXPECT_EQ(visibilities_of(chain), std::vector<Visibility>(3, uniform_noise(1)));
    chain.visibility = {uniform_noise(5)};
    EXPECT_EQ(visibilities_of(chain), std::vector<Visibility>(3, uniform_noise(5)));
    chain.visibility = {uniform_noise(5), uniform_noise(6), uniform_noise(7)};
    EXPECT_EQ(visibilities_of(chain), chain.visibility);
}

}  // namespace
}  // namespace overlook::discrete
