#include "tools/make_sample/landscape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "formats/parallel.h"
#include "tools/make_sample/drainage.h"
#include "tools/make_sample/erosion.h"
#include "tools/make_sample/noise.h"

namespace overlook::sample {
namespace {

LandscapeOptions small(uint64_t seed) {
    LandscapeOptions options;
    options.seed = seed;
    options.side = 129;
    options.cell_size_m = 120;
    return options;
}

Grid grid_of(const Landscape& landscape, double cell_m) {
    Grid grid(landscape.side, cell_m);
    std::copy(landscape.height_m.begin(), landscape.height_m.end(), grid.values.begin());
    return grid;
}

std::vector<uint8_t> border_of(const Grid& grid) {
    std::vector<uint8_t> is_border(grid.values.size());
    for (size_t i = 0; i < is_border.size(); ++i) is_border[i] = grid.is_border(i);
    return is_border;
}

// A rough surface with pits and cliffs.
Grid rubble(uint32_t side) {
    Grid grid(side, 10);
    for (size_t i = 0; i < grid.values.size(); ++i) grid.values[i] = 100 * unit_from_hash(hash_of(5, i, 0));
    return grid;
}

// The greatest height by which a cell stands above what its limit allows over a neighbour.
double greatest_excess_m(const Grid& grid, const Grid& slope_limit) {
    double excess_m = 0;
    for (size_t i = 0; i < grid.values.size(); ++i)
        for_neighbours(grid.side, i, [&](size_t next, double distance, size_t) {
            double allowed_m = slope_limit.values[i] * distance * grid.cell_m;
            excess_m = std::max(excess_m, grid.values[i] - grid.values[next] - allowed_m);
        });
    return excess_m;
}

TEST(Landscape, IsTheSameWithAnyThreadCount) {
    set_thread_count(1);
    Landscape one = make_landscape(small(3));
    for (unsigned threads : {2u, 7u}) {
        set_thread_count(threads);
        EXPECT_EQ(one.height_m, make_landscape(small(3)).height_m) << threads << " threads";
    }
    set_thread_count(0);
}

// The number is what g++ 12 and clang 14 give, with and without optimisation: it changes only with the
// landscape itself.
TEST(Landscape, IsTheSameWithAnyCompiler) {
    uint64_t hash = 0;
    for (float height_m : make_landscape(small(1)).height_m) hash = hash_of(hash, uint64_t(height_m / kHeightStepM), 0);
    EXPECT_EQ(hash, 5729445652592228459u);
}

TEST(Landscape, DiffersBySeed) {
    Landscape a = make_landscape(small(1)), b = make_landscape(small(2));
    size_t same = 0;
    for (size_t i = 0; i < a.height_m.size(); ++i) same += a.height_m[i] == b.height_m[i];
    EXPECT_LT(same, a.height_m.size() / 10);
}

TEST(Landscape, DrainsEverywhere) {
    for (uint64_t seed : {1, 2, 3, 4}) {
        Grid grid = grid_of(make_landscape(small(seed)), 120);
        EXPECT_EQ(fill_depressions(grid, border_of(grid)), 0u) << "seed " << seed;
    }
}

TEST(Landscape, StandsNowhereSteeperThanItsLimit) {
    Landscape landscape = make_landscape(small(1));
    Grid grid = grid_of(landscape, 120), limit(landscape.side, 120, landscape.slope_limit);
    EXPECT_LE(greatest_excess_m(grid, limit), kHeightStepM);
}

TEST(Landscape, HasMountainsAPlainAndALake) {
    Landscape landscape = make_landscape(small(1));
    auto [lowest, highest] = std::minmax_element(landscape.height_m.begin(), landscape.height_m.end());
    EXPECT_GT(*lowest, 250);
    EXPECT_GT(*highest - *lowest, 1000);
    size_t low = 0, level = 0;
    for (size_t i = 1; i < landscape.height_m.size(); ++i) {
        low += landscape.height_m[i] < 500;
        level += landscape.height_m[i] == landscape.height_m[i - 1];
    }
    EXPECT_GT(low, landscape.height_m.size() / 10);
    EXPECT_GT(level, 40u);
}

TEST(Landscape, HeightsAreMultiplesOfTheirStep) {
    for (float height_m : make_landscape(small(1)).height_m)
        ASSERT_EQ(height_m / kHeightStepM, std::floor(height_m / kHeightStepM));
}

TEST(Drainage, OfAPlaneIsItsLengthAboveEachCell) {
    Grid plane(20, 10);
    std::vector<uint8_t> is_outlet(400);
    for (uint32_t row = 0; row < 20; ++row)
        for (uint32_t column = 0; column < 20; ++column) plane.at(column, row) = 7.0 * column;
    for (uint32_t row = 0; row < 20; ++row) is_outlet[row * 20] = 1;
    std::vector<double> area_m2 = drained_area_m2(drain(plane, is_outlet, 0, 1), 10);
    for (uint32_t i = 0; i < 400; ++i) EXPECT_EQ(area_m2[i], 100.0 * (20 - i % 20)) << "cell " << i;
}

TEST(Drainage, BringsAllAreaToTheOutlets) {
    Grid grid = rubble(60);
    std::vector<uint8_t> is_outlet = border_of(grid);
    Drainage drainage = drain(grid, is_outlet, 0.9, 4);
    std::vector<double> area_m2 = drained_area_m2(drainage, 10);
    double sum = 0;
    for (size_t i = 0; i < area_m2.size(); ++i) sum += is_outlet[i] ? area_m2[i] : 0;
    EXPECT_EQ(sum, 100.0 * 60 * 60);
}

TEST(Drainage, OrderPutsReceiversFirst) {
    Grid grid = rubble(60);
    Drainage drainage = drain(grid, border_of(grid), 0.9, 4);
    std::vector<uint8_t> is_placed(grid.values.size());
    ASSERT_EQ(drainage.order.size(), grid.values.size());
    for (uint32_t cell : drainage.order) {
        ASSERT_TRUE(drainage.receiver[cell] == cell || is_placed[drainage.receiver[cell]]);
        ASSERT_FALSE(is_placed[cell]);
        is_placed[cell] = 1;
    }
}

TEST(Erosion, FillsABowlToItsLowestBrim) {
    Grid bowl(11, 1, 5);
    bowl.at(5, 5) = 1;
    for (uint32_t x = 5; x < 11; ++x) bowl.at(x, 5) = x == 5 ? 1 : 3;
    EXPECT_EQ(fill_depressions(bowl, border_of(bowl)), 1u);
    EXPECT_EQ(bowl.at(5, 5), 3);
}

// On a line of rivers that never join, z' = uplift / (softness * sqrt(A)) holds in the steady state.
TEST(Erosion, RiversReachTheSlopeThatBalancesTheUplift) {
    uint32_t side = 16;
    Grid height_m(side, 50), uplift_m(side, 50, 30), softness(side, 50, 1), limit(side, 50, 100);
    std::vector<uint8_t> is_outlet(side * side);
    for (uint32_t row = 0; row < side; ++row) is_outlet[row * side] = 1;
    for (uint32_t i = 0; i < side * side; ++i) height_m.values[i] = 0.001 * (i % side);
    Rivers rivers;
    rivers.wander = 0;
    rivers.step_count = 400;
    rivers.step = 1;
    cut_rivers(height_m, uplift_m, softness, limit, is_outlet, rivers);
    for (uint32_t column = 1; column < side; ++column) {
        double rise_m = height_m.at(column, 8) - height_m.at(column - 1, 8);
        EXPECT_NEAR(rise_m / 50, 30 / std::sqrt(2500.0 * (side - column)), 1e-9) << "column " << column;
    }
}

TEST(Erosion, RockFallLeavesASpireAsACone) {
    Grid spire(41, 10), limit(41, 10, 0.5);
    spire.at(20, 20) = 1e9;
    spire.at(5, 5) = -30;
    fall_rock(spire, limit);
    EXPECT_EQ(spire.at(20, 20), 5);
    EXPECT_EQ(spire.at(6, 5), -25);
    EXPECT_EQ(spire.at(10, 5), -5);
    EXPECT_EQ(spire.at(12, 5), 0);
}

TEST(Erosion, RockFallKeepsEveryLimitAndMakesNoPit) {
    Grid grid = rubble(60), limit(60, 10);
    for (size_t i = 0; i < limit.values.size(); ++i) limit.values[i] = 0.3 + unit_from_hash(hash_of(9, i, 0));
    fill_depressions(grid, border_of(grid));
    Grid before = grid;
    fall_rock(grid, limit);
    EXPECT_LE(greatest_excess_m(grid, limit), 1e-9);
    for (size_t i = 0; i < grid.values.size(); ++i) ASSERT_LE(grid.values[i], before.values[i]);
    EXPECT_EQ(fill_depressions(grid, border_of(grid)), 0u);
}

TEST(Noise, IsZeroOnWholeNumbersAndStaysInRange) {
    double greatest = 0;
    for (int i = -40; i < 40; ++i) {
        EXPECT_EQ(gradient_noise(1, i, 3 * i), 0);
        greatest = std::max(greatest, std::abs(gradient_noise(1, i * 0.37, i * 0.73)));
    }
    EXPECT_GT(greatest, 0.2);
    EXPECT_LT(greatest, 0.8);
}

}  // namespace
}  // namespace overlook::sample
