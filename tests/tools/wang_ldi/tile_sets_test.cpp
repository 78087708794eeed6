// Sets of tiles are what they are said to be, the search finds the best of them, and Robinson's are Robinson's.
#include "tools/bake/wang_ldi/tile_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tools/bake/wang_ldi/periodicity.h"

namespace overlook::wang_ldi {
namespace {

TileSet made(const SetOptions& options, SearchReport& report) {
    auto set = make_tile_set(options, report);
    EXPECT_TRUE(set) << set.error().message;
    return set ? *set : TileSet{};
}
TileSet made(const SetOptions& options) {
    SearchReport report;
    return made(options, report);
}
SetOptions stochastic(uint32_t tiles, uint32_t colours = 2) {
    SetOptions options;
    options.tiles = tiles, options.horizontal_colours = options.vertical_colours = colours;
    return options;
}

TEST(BalancedSets, AreThe148OfEightTilesAndAllDifferent) {
    std::vector<TileSet> sets = balanced_sets(2);
    EXPECT_EQ(sets.size(), 148u);
    std::set<std::string> texts;
    for (const TileSet& set : sets) texts.insert(text_of(set));
    EXPECT_EQ(texts.size(), sets.size());
    EXPECT_EQ(balanced_sets(4).size(), 1u);
}

TEST(BalancedSets, HaveEveryColourAsOftenOnEverySide) {
    for (uint32_t per_pair : {2u, 3u, 4u})
        for (const TileSet& set : balanced_sets(per_pair)) {
            std::array<uint32_t, 4> ones{};
            std::map<std::pair<int, int>, uint32_t> pairs;
            for (const Tile& tile : set.tiles) {
                ones[0] += tile.north, ones[1] += tile.east, ones[2] += tile.south, ones[3] += tile.west;
                ++pairs[{tile.west, tile.south}];
            }
            for (uint32_t count : ones) EXPECT_EQ(2 * count, set.tiles.size());
            for (const auto& [pair, count] : pairs) EXPECT_EQ(count, per_pair);
        }
}

TEST(SetSearch, KeepsTheSetWithTheLeastCorrelation) {
    SearchReport report;
    TileSet best = made(stochastic(8), report);
    EXPECT_EQ(report.candidates, 148u);
    EXPECT_TRUE(report.is_exhaustive);
    EXPECT_LE(report.best, 0.0025);
    EXPECT_GE(report.worst, 0.14);          // most of the sets that the paper's rules allow do repeat
    double kept = score_of(best, 1024, 7);  // other random numbers than those of the search
    EXPECT_LE(kept, 0.003);
    int worse = 0;
    for (const TileSet& set : balanced_sets(2)) worse += score_of(set, 256, 7) > 0.02;
    EXPECT_GE(worse, 60);
}

TEST(SetSearch, KeepsCorrelationUnderTwoHundredthsByDefault) {
    SearchReport report;
    TileSet set = made(SetOptions{}, report);
    ASSERT_EQ(set.tiles.size(), 12u);
    EXPECT_EQ(report.dead_ending, 0u);
    for (bool avoids : {false, true}) {
        TilingOptions options;
        options.seed = 3, options.avoids_equal_neighbours = avoids;
        auto tiling = tile_row_by_row(set, 1024, 1024, options);
        ASSERT_TRUE(tiling);
        EXPECT_LE(std::abs(greatest_correlation(*tiling).value), 0.02) << avoids;
    }
}

TEST(SetSearch, FindsSetsOfMoreColours) {
    SetOptions options = stochastic(18, 3);
    options.candidates = 60;
    SearchReport report;
    TileSet set = made(options, report);
    EXPECT_EQ(set.tiles.size(), 18u);
    EXPECT_FALSE(report.is_exhaustive);
    EXPECT_LE(report.best, 0.01);
    std::set<std::array<int, 4>> different;
    for (const Tile& tile : set.tiles) different.insert({tile.north, tile.east, tile.south, tile.west});
    EXPECT_EQ(different.size(), 18u);
    EXPECT_TRUE(made(options) == set);
    options.seed = 2;
    EXPECT_FALSE(made(options) == set);
}

TEST(TileSet, OfWrongCountsIsRefused) {
    SearchReport report;
    for (SetOptions options : {stochastic(9), stochastic(4), stochastic(20), stochastic(12, 3), stochastic(0)}) {
        auto set = make_tile_set(options, report);
        ASSERT_FALSE(set) << options.tiles;
        EXPECT_EQ(set.error().exit, Exit::bad_command);
    }
    SetOptions many = stochastic(16);
    many.variants = 16;
    auto set = make_tile_set(many, report);
    ASSERT_FALSE(set);
    EXPECT_NE(set.error().message.find("255"), std::string::npos);
}

TEST(TileSet, OfCornersHasATileForEveryFourAndCornersThatAgree) {
    SetOptions options;
    options.kind = SetKind::corners, options.corner_density = {1, 0.5f, 0.25f};
    TileSet set = made(options);
    EXPECT_EQ(set.tiles.size(), 81u);
    std::set<std::array<uint8_t, 4>> corners;
    for (const Tile& tile : set.tiles) {
        corners.insert(corners_of(set, tile));
        const EdgeColour &west = set.vertical[tile.west], &east = set.vertical[tile.east];
        EXPECT_EQ((std::array<uint8_t, 4>{west.low, east.low, west.high, east.high}), corners_of(set, tile));
    }
    EXPECT_EQ(corners.size(), 81u);
}

TEST(TileSet, WithBordersHasATileForEveryBorder) {
    SetOptions options;
    options.has_borders = true;
    TileSet set = made(options);
    EXPECT_EQ(set.tiles.size(), 12u + 31u);
    EXPECT_EQ(set.corner_density, (std::vector<float>{1, 0}));
    std::map<std::array<uint8_t, 4>, int> by_corners;
    for (const Tile& tile : set.tiles) ++by_corners[corners_of(set, tile)];
    EXPECT_EQ(by_corners.size(), 16u);
    EXPECT_EQ((by_corners[{1, 1, 1, 1}]), 1);
    EXPECT_EQ((by_corners[{1, 0, 0, 0}]), 4);  // two edges between planted corners, two colours each
}

TEST(RobinsonSet, HasSixteenTilesOfSixColoursThatFormulaAndRulesAgreeOn) {
    TileSet set = robinson_set();
    EXPECT_EQ(set.tiles.size(), 16u);
    EXPECT_EQ(set.horizontal.size(), 6u);
    EXPECT_EQ(set.vertical.size(), 6u);
    NeighbourCount count = count_neighbours(set, robinson_tiling(set, 1000, 1000, 5));
    EXPECT_EQ(count.disagreeing, 0u);
}

// Whether the set tiles a torus of these sides: its tilings, should there be any, repeat.
bool tiles_torus(const TileSet& set, uint32_t columns, uint32_t rows, std::vector<uint8_t>& placed) {
    size_t at = placed.size();
    if (at == size_t(columns) * rows) return true;
    size_t x = at % columns, y = at / columns;
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        const Tile& tile = set.tiles[t];
        if (x > 0 && tile.west != set.tiles[placed[at - 1]].east) continue;
        if (y > 0 && tile.south != set.tiles[placed[at - columns]].north) continue;
        if (x + 1 == columns && tile.east != (columns == 1 ? tile : set.tiles[placed[at - x]]).west) continue;
        if (y + 1 == rows && tile.north != (rows == 1 ? tile : set.tiles[placed[x]]).south) continue;
        placed.push_back(uint8_t(t));
        if (tiles_torus(set, columns, rows, placed)) return true;
        placed.pop_back();
    }
    return false;
}

TEST(RobinsonSet, TilesNoSmallTorusWhileTheStochasticOnesDo) {
    TileSet robinson = robinson_set(), eight = balanced_sets(2)[0];
    for (uint32_t columns = 1; columns <= 6; ++columns)
        for (uint32_t rows = 1; rows <= 6; ++rows) {
            std::vector<uint8_t> placed;
            EXPECT_FALSE(tiles_torus(robinson, columns, rows, placed)) << columns << " x " << rows;
        }
    std::vector<uint8_t> placed;
    EXPECT_TRUE(tiles_torus(eight, 3, 3, placed));
}

TEST(RobinsonSet, ShowsItsPlaidInTheSameNumber) {
    TileSet set = robinson_set();
    Tiling tiling = robinson_tiling(set, 512, 512, 1);
    EXPECT_GE(greatest_correlation(tiling).value, 0.5);
    SpectrumShape plaid = shape_of(spectrum_of(tiling, 16, 256));
    EXPECT_GE(plaid.share_of_top_hundredth, 0.7);
    auto twelve = tile_row_by_row(made(SetOptions{}), 512, 512, {});
    ASSERT_TRUE(twelve);
    EXPECT_LE(shape_of(spectrum_of(*twelve, 12, 256)).share_of_top_hundredth, 0.04);
}

// Ground whose corners all have one density is covered by tiles between corners of that density.
TEST(CornerSets, OfWhichADensityHasOneCornerColourSaySo) {
    SetOptions options;
    options.kind = SetKind::corners;
    SearchReport report;
    auto repeated = [&](const std::vector<float>& densities, uint32_t variants) {
        options.corner_density = densities, options.variants = variants;
        auto set = make_tile_set(options, report);
        EXPECT_TRUE(set);
        return repeated_densities(*set);
    };
    EXPECT_EQ(repeated({1, 0.5f, 0}, 1), (std::vector<float>{1, 0.5f}));
    EXPECT_EQ(repeated({0, 1}, 1), std::vector<float>{1});
    EXPECT_EQ(repeated({1, 1, 0}, 1), std::vector<float>());
    EXPECT_EQ(repeated({1, 1, 0.5f}, 1), std::vector<float>{0.5f});
    EXPECT_EQ(repeated({1, 0.5f, 0}, 3), std::vector<float>());
    options = {};
    EXPECT_EQ(repeated_densities(*make_tile_set(options, report)), std::vector<float>());
    options.has_borders = true;
    EXPECT_EQ(repeated_densities(*make_tile_set(options, report)), std::vector<float>());
    options = {}, options.tiles = 1, options.horizontal_colours = options.vertical_colours = 1;  // meant to repeat
    EXPECT_EQ(repeated_densities(*make_tile_set(options, report)), std::vector<float>());
}

}  // namespace
}  // namespace overlook::wang_ldi
