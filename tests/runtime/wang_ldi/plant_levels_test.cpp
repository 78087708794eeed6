// Plants drawn as geometry: nothing that is in the picture is left out, no level is coarser than asked, none finer than need be,
// and they give way to each other without a jump.
#include "runtime/wang_ldi/plant_levels.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "tests/runtime/discrete/chains.h"

namespace overlook::wang_ldi {
namespace {

// A mast of 40 m by 60 rings at its finest, of fewer in each of three coarser levels.
discrete::Chain mast() {
    discrete::Chain chain = discrete::made::empty_chain({-2, -2, 0}, 41);
    uint32_t rings = 60;
    double error_m = 1e-5;
    for (int k = 0; k < 4; ++k, rings /= 2, error_m = k == 1 ? 0.01 : 4 * error_m) {
        discrete::Level level;
        for (uint32_t ring = 0; ring < rings; ++ring)
            for (int side = 0; side < 8; ++side) {
                auto at = [&](int s, uint32_t r) {
                    double angle = s * M_PI / 4;
                    return glm::dvec3(0.5 * std::cos(angle), 0.5 * std::sin(angle), 40.0 * r / rings);
                };
                discrete::made::add_quad(chain, level,
                                         {at(side, ring), at(side + 1, ring), at(side + 1, ring + 1), at(side, ring + 1)},
                                         {200, 200, 200, 255});
            }
        discrete::made::end_level(chain, std::move(level), error_m);
    }
    return chain;
}

bool is_outside_one_side(const view::Camera& camera, std::span<const glm::dvec3> corners) {
    for (const glm::dvec3& side : view::sides_of(camera)) {
        bool all = true;
        for (const glm::dvec3& at : corners) all &= glm::dot(side, at - camera.position_m) < 1e-6;
        if (all) return true;
    }
    glm::dvec3 forward = view::axes_of(camera).forward;
    return std::all_of(corners.begin(), corners.end(),
                       [&](const glm::dvec3& at) { return glm::dot(forward, at - camera.position_m) < camera.near_m; });
}

// Those of its triangles that an item of the list leaves out.
std::vector<std::array<glm::dvec3, 3>> left_out(const discrete::Chain& chain, const discrete::FrameList& list,
                                                const discrete::Item& item, const discrete::Placement& placement) {
    const discrete::Level& level = chain.levels[item.level];
    std::vector<bool> is_drawn(level.indices.size(), item.run_count == 0);
    for (uint32_t r = item.first_run; r < item.first_run + item.run_count; ++r)
        for (uint32_t i = 0; i < list.runs[r].index_count; ++i)
            is_drawn[level.draws[list.runs[r].draw].first_index + list.runs[r].first_index + i] = true;
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (size_t i = 0; i < level.indices.size(); i += 3) {
        if (is_drawn[i]) continue;
        auto& corners = triangles.emplace_back();
        for (size_t c = 0; c < 3; ++c) corners[c] = placement.at(position_m(chain, level.vertices[level.indices[i + c]]));
    }
    return triangles;
}

TEST(PlantLevels, LeaveOutOnlyWhatIsOutsideAndKeepTheError) {
    discrete::Chain chain = mast();
    PlantForm form = form_of(chain);
    EXPECT_NEAR(form.reach_m, 0.5, 1e-3);
    EXPECT_NEAR(form.high_m, 40, 1e-2);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    PlantPlaces places;
    for (int n = 0; n < 60; ++n) {
        double turn = 6 * unit(random);
        places.placements.push_back(
            {{80 * unit(random) - 40, 80 * unit(random) - 40, -1}, std::cos(turn), std::sin(turn), 0.8 + 0.4 * unit(random)});
        places.shares.push_back(1);
    }
    uint64_t left = 0, cut = 0;
    std::set<uint32_t> levels;
    for (double heading_deg = 0; heading_deg < 360; heading_deg += 20)
        for (double error_px : {0.0, 0.5, 2.0}) {
            view::Camera camera;
            camera.position_m = {0, 0, 1.7}, camera.heading_deg = heading_deg, camera.pitch_deg = -4, camera.near_m = 0.05;
            camera.width_px = 640, camera.height_px = 480;
            ListedPlants listed = plants_listed(form, places, camera, {error_px});
            EXPECT_TRUE(error_px == 0 || listed.error_px <= error_px) << listed.error_px;
            std::set<uint32_t> seen;
            uint64_t triangles = 0;
            for (const discrete::Item& item : listed.frame.items) {
                seen.insert(item.instance), levels.insert(item.level);
                EXPECT_TRUE(error_px > 0 || item.level == 0);
                auto missing = left_out(chain, listed.frame, item, places.placements[item.instance]);
                triangles += chain.levels[item.level].triangle_count() - missing.size();
                cut += item.run_count > 0;
                for (const auto& corners : missing) EXPECT_TRUE(is_outside_one_side(camera, corners));
                left += missing.size();
            }
            EXPECT_EQ(triangles, listed.frame.triangle_count);
            for (uint32_t p = 0; p < places.placements.size(); ++p) {
                if (seen.contains(p)) continue;
                discrete::Item whole{p, 0};
                whole.first_run = 0, whole.run_count = 1;
                discrete::FrameList none;
                none.runs.push_back({0, 0, 0});
                for (const auto& corners : left_out(chain, none, whole, places.placements[p]))
                    EXPECT_TRUE(is_outside_one_side(camera, corners)) << p;
            }
        }
    EXPECT_GT(left, 10'000u);
    EXPECT_GT(cut, 100u);
    EXPECT_GE(levels.size(), 3u);
}

// Errors of a chain's levels, of no triangles.
PlantForm form_with(std::initializer_list<double> errors_m) {
    PlantForm form;
    for (double error_m : errors_m) form.facts.levels.push_back({error_m, 0, 0, {}});
    return form;
}

double share_of(const LevelMix& mix, uint32_t level) {
    if (mix.coarser == level) return mix.coarser_share;
    return mix.finer == level ? 1 - mix.coarser_share : 0;
}

// The fifth is never worth having, the third ends before it would be whole.
TEST(PlantLevels, GiveWayToEachOtherWithinWhatIsAskedAndWithoutAJump) {
    constexpr double kFade = 0.5, kStep = 1e-4;
    PlantForm form = form_with({0, 0.01, 0.1, 0.13, 0.4, 0.2, 0.9});
    for (double within_m = 0; within_m < 3; within_m += kStep) {
        LevelMix mix = levels_within(form, within_m, kFade), next = levels_within(form, within_m + kStep, kFade);
        EXPECT_TRUE(mix.coarser_share >= 0 && mix.coarser_share <= 1) << within_m;
        for (uint32_t level : {mix.finer, mix.coarser}) {
            EXPECT_LE(form.facts.levels[level].error_m, within_m);
            EXPECT_NE(level, 4u);
        }
        if (within_m < 0.02) continue;  // where a step is much of a fade
        for (uint32_t level = 0; level < form.facts.levels.size(); ++level)
            EXPECT_NEAR(share_of(mix, level), share_of(next, level), 0.02) << level << " at " << within_m;
    }
    EXPECT_EQ(levels_within(form, 0.015, kFade).finer, 0u);
    EXPECT_NEAR(levels_within(form, 0.015, kFade).coarser_share, 0.5, 1e-9);
    EXPECT_TRUE(levels_within(form, 0.02, kFade).coarser == 1 && levels_within(form, 0.02, kFade).is_one());
    EXPECT_NEAR(levels_within(form, 0.115, kFade).coarser_share, 0.5, 1e-9);
    EXPECT_TRUE(levels_within(form, 0.3, kFade).finer == 3 && levels_within(form, 0.3, kFade).coarser == 5);
    EXPECT_TRUE(levels_within(form, 5, kFade).coarser == 6 && levels_within(form, 5, kFade).is_one());
}

TEST(PlantLevels, ChangeAtOnceWithoutAFade) {
    PlantForm form = form_with({0, 0.01, 0.1, 0.1, 0.4});
    for (double within_m = 0; within_m < 1; within_m += 1e-3) {
        LevelMix mix = levels_within(form, within_m, 0);
        EXPECT_TRUE(mix.is_one() && mix.coarser_share == 1);
        EXPECT_EQ(mix.coarser, within_m < 0.01 ? 0u : within_m < 0.1 ? 1u : within_m < 0.4 ? 3u : 4u) << within_m;
    }
}

// Of each plant what is listed of the door adds up to its own share, and nothing is off by more than asked.
TEST(PlantLevels, SharesOfAPlantAddUpToItsOwn) {
    discrete::Chain chain = mast();
    std::vector<PlantForm> forms{form_of(chain)};
    std::vector<PlantPlaces> places(1);
    for (int n = 0; n < 400; ++n) {
        places[0].placements.push_back({{0.1 * n - 20, 3 + n, -1}, 1, 0, 1});
        places[0].shares.push_back(n % 3 == 0 ? 0.25f : 1.0f);
    }
    view::Camera camera;
    camera.position_m = {0, 0, 1.7}, camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.05;
    size_t in_change = 0, in_both = 0;
    for (double fade : {0.0, 0.5}) {
        std::map<uint32_t, std::vector<discrete::Item>> by_plant;
        uint64_t triangles = 0, counted = 0, plants = 0;
        for (const PlantList& list : plant_lists(forms, places, camera, {2, fade})) {
            EXPECT_LE(list.listed.error_px, 2);
            for (const discrete::Item& item : list.listed.frame.items) {
                EXPECT_EQ(list.is_fading, item.show != discrete::Show::whole);
                by_plant[item.instance].push_back(item);
                if (item.run_count == 0) counted += chain.levels[item.level].triangle_count();
                for (uint32_t r = item.first_run; r < item.first_run + item.run_count; ++r)
                    counted += list.listed.frame.runs[r].index_count / 3;
            }
            triangles += list.listed.frame.triangle_count, plants += list.listed.frame.in_view_count;
        }
        EXPECT_EQ(triangles, counted);
        EXPECT_EQ(plants, by_plant.size());
        EXPECT_GT(by_plant.size(), 300u);
        for (const auto& [instance, items] : by_plant) {
            double share = double(places[0].shares[instance]);
            ASSERT_LE(items.size(), fade > 0 ? 2u : 1u);
            if (items.size() == 1) {
                EXPECT_EQ(items[0].share, share);
                continue;
            }
            EXPECT_EQ(items[0].show, discrete::Show::dithered_out);
            EXPECT_EQ(items[1].show, discrete::Show::dithered_in);
            EXPECT_LT(items[0].level, items[1].level);
            EXPECT_EQ(items[0].share, items[1].share);
            EXPECT_EQ(items[0].up_to, share);
            EXPECT_LT(items[0].share, share);
            ++in_change, in_both += share < 1;
        }
    }
    EXPECT_GT(in_change, 30u);
    EXPECT_GT(in_both, 10u);
}

}  // namespace
}  // namespace overlook::wang_ldi
