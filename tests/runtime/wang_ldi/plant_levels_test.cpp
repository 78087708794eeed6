// Plants drawn as geometry: nothing that is in the picture is left out, no level is coarser than asked, and none finer than need
// be.
#include "runtime/wang_ldi/plant_levels.h"

#include <gtest/gtest.h>

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
            ListedPlants listed = plants_listed(form, places, camera, error_px);
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

}  // namespace
}  // namespace overlook::wang_ldi
