// Light amid what is planted follows from its leaves.
#include "runtime/wang_ldi/canopy.h"

#include <gtest/gtest.h>

#include "tests/runtime/discrete/chains.h"

namespace overlook::wang_ldi {
namespace {

// A level square at a height, seen from both sides.
discrete::Chain leaf(double height_m, double side_m) {
    discrete::Chain chain = discrete::made::empty_chain(glm::dvec3(-1, -1, 0), 4);
    discrete::Level level;
    double half = side_m / 2;
    discrete::made::add_quad(
        chain, level, {{{-half, -half, height_m}, {half, -half, height_m}, {half, half, height_m}, {-half, half, height_m}}},
        {255, 255, 255, 255});
    discrete::made::end_level(chain, std::move(level), 0);
    chain.surfaces[0].is_two_sided = true;
    return chain;
}

TEST(Canopy, LightFallsByTheLeavesAbove) {
    std::vector<discrete::Chain> chains{leaf(1, 1), leaf(2, 1)};
    Planting planting;
    planting.tile_size_m = 2, planting.models.resize(2), planting.tiles.resize(2);
    // Of 8 m2 of ground two leaves of 1 m2 at 1 m, one at 2 m.
    planting.tiles[0] = {{0, 1, 1, 0, 1, Owner::interior}, {1, 1, 1, 0, 1, Owner::interior}};
    planting.tiles[1] = {{0, 1, 1, 0, 1, Owner::interior}};
    glm::dvec3 to_sun = glm::normalize(glm::dvec3(0, 1, 1));
    Canopy canopy = canopy_of(planting, chains, to_sun);
    EXPECT_NEAR(canopy.top_m, 2, 1e-3);
    auto sun_below = [&](double leaves_m2) { return std::exp(-0.5 * leaves_m2 / 8 / to_sun.z); };
    EXPECT_NEAR(double(canopy.open[0].x), sun_below(3), 1e-4);
    EXPECT_NEAR(double(canopy.open[20].x), sun_below(1), 1e-4);
    EXPECT_NEAR(double(canopy.open.back().x), sun_below(0.5), 1e-4);  // half of the leaf itself
    for (size_t k = 1; k < kCanopySteps; ++k) {
        EXPECT_GE(canopy.open[k].x, canopy.open[k - 1].x);
        EXPECT_GE(canopy.open[k].y, canopy.open[k - 1].y);
        EXPECT_LE(canopy.open[k].y, 1);
    }
    // The same leaves in two plants that stand on 2 m2 of it.
    for (Model& model : planting.models) model.tight_radius_m = float(std::sqrt(2.0 / 3 / M_PI));
    EXPECT_NEAR(double(canopy_of(planting, chains, to_sun).open[0].x), sun_below(3 * 4), 1e-4);
    for (Model& model : planting.models) model.tight_radius_m = 0;
    // A closed thing has two sides for what it hides.
    chains[0].surfaces[0].is_two_sided = chains[1].surfaces[0].is_two_sided = false;
    EXPECT_NEAR(double(canopy_of(planting, chains, to_sun).open[0].x), sun_below(1.5), 1e-4);
}

TEST(Canopy, OfNothingIsOpen) {
    Planting planting;
    planting.tile_size_m = 2, planting.tiles.resize(3);
    for (const glm::vec2& open : canopy_of(planting, {}, {0, 0, 1}).open) EXPECT_EQ(open, glm::vec2(1));
}

}  // namespace
}  // namespace overlook::wang_ldi
