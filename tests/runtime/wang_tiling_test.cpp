// Tilings agree at every edge and corner, never put a tile beside itself where that is asked, follow maps of densities, and come
// the same tile by tile in any order.
#include "runtime/wang_ldi/tiling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/periodicity.h"
#include "tools/bake/wang_ldi/tile_sets.h"

namespace overlook::wang_ldi {
namespace {

const TileSet& set_of(uint32_t tiles, uint32_t variants = 1, bool has_borders = false) {
    static std::map<std::tuple<uint32_t, uint32_t, bool>, TileSet> made;  // a search each
    TileSet& set = made[{tiles, variants, has_borders}];
    if (!set.tiles.empty()) return set;
    SetOptions options;
    options.tiles = tiles, options.variants = variants, options.has_borders = has_borders;
    SearchReport report;
    auto found = make_tile_set(options, report);
    EXPECT_TRUE(found) << found.error().message;
    if (found) set = std::move(*found);
    return set;
}
TileSet corners_of_densities(std::vector<float> densities) {
    SetOptions options;
    options.kind = SetKind::corners, options.corner_density = std::move(densities);
    SearchReport report;
    return *make_tile_set(options, report);
}

Tiling tiled(const TileSet& set, uint32_t columns, uint32_t rows, const TilingOptions& options = {}) {
    auto tiling = tile_row_by_row(set, columns, rows, options);
    EXPECT_TRUE(tiling) << tiling.error().message;
    return tiling ? std::move(*tiling) : Tiling{};
}
Tiling window_of(const RandomTiling& random, int64_t x0, int64_t y0, uint32_t side) {
    Tiling tiling{side, side, {}};
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) tiling.tiles.push_back(random.at(x0 + x, y0 + y));
    return tiling;
}

TEST(RowTiling, AgreesAtEveryEdgeOfTenMillionTiles) {
    TileSet set = set_of(12);
    Tiling tiling = tiled(set, 10000, 1000);
    NeighbourCount count = count_neighbours(set, tiling);
    EXPECT_EQ(count.disagreeing, 0u);
    EXPECT_EQ(count.equal, 0u);
}

TEST(RowTiling, OfEightPutsTilesBesideThemselvesOnlyWhereThatIsAllowed) {
    TileSet set = set_of(8);
    TilingOptions options;
    options.avoids_equal_neighbours = false;
    NeighbourCount count = count_neighbours(set, tiled(set, 300, 300, options));
    EXPECT_EQ(count.disagreeing, 0u);
    EXPECT_GE(count.equal, 1000u);
}

TEST(RowTiling, NeverDeadEndsWhereEqualNeighboursAreAvoided) {
    // Row by row without looking ahead most of these sets leave a place that nothing fits.
    uint32_t dead_ending = 0, tiled_anyway = 0;
    for (const TileSet& set : balanced_sets(2)) {
        dead_ending += can_dead_end(set);
        auto tiling = tile_row_by_row(set, 60, 60, {});
        if (!tiling) continue;
        NeighbourCount count = count_neighbours(set, *tiling);
        EXPECT_EQ(count.disagreeing + count.equal, 0u);
        ++tiled_anyway;
    }
    EXPECT_EQ(dead_ending, 129u);
    EXPECT_EQ(tiled_anyway, 148u);
    for (const TileSet& set : balanced_sets(3)) EXPECT_FALSE(can_dead_end(set));
}

TEST(RowTiling, OfOneTileRepeatsIt) {
    SetOptions options;
    options.tiles = options.horizontal_colours = options.vertical_colours = 1;
    SearchReport report;
    auto set = make_tile_set(options, report);
    ASSERT_TRUE(set);
    TilingOptions equal;
    equal.avoids_equal_neighbours = false;
    Tiling tiling = tiled(*set, 20, 20, equal);
    EXPECT_EQ(std::set<uint8_t>(tiling.tiles.begin(), tiling.tiles.end()), std::set<uint8_t>{0});
    auto none = tile_row_by_row(*set, 20, 20, {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().exit, Exit::impossible);
}

TEST(RowTiling, IsAnotherForAnotherSeedAndTheSameForTheSame) {
    TileSet set = set_of(12);
    TilingOptions one, two;
    two.seed = 2;
    EXPECT_TRUE(tiled(set, 50, 50, one).tiles == tiled(set, 50, 50, one).tiles);
    EXPECT_FALSE(tiled(set, 50, 50, one).tiles == tiled(set, 50, 50, two).tiles);
}

TEST(RowTiling, PlantsAnyBorderThatItIsGiven) {
    TileSet set = set_of(12, 1, true);
    TilingOptions options;
    options.corner_at = [](int64_t x, int64_t y) { return uint8_t(std::hypot(double(x) - 40, double(y) - 40) > 33); };
    options.avoids_equal_neighbours = false;  // bare ground is one tile
    Tiling tiling = tiled(set, 80, 80, options);
    EXPECT_EQ(count_neighbours(set, tiling).disagreeing, 0u);
    uint32_t partly = 0;
    for (uint32_t y = 0; y < 80; ++y)
        for (uint32_t x = 0; x < 80; ++x) {
            std::array<uint8_t, 4> corners = corners_of(set, set.tiles[tiling.at(x, y)]);
            for (uint32_t c = 0; c < 4; ++c) EXPECT_EQ(corners[c], options.corner_at(x + (c & 1), y + (c >> 1)));
            partly += corners != std::array<uint8_t, 4>{0, 0, 0, 0} && corners != std::array<uint8_t, 4>{1, 1, 1, 1};
        }
    EXPECT_GE(partly, 200u);
}

TEST(RowTiling, StandsOnThePlaneAsItWasMadeAndRepeatsBeyond) {
    TileSet set = set_of(8);
    TilingOptions options;
    options.avoids_equal_neighbours = false;
    auto rows = RowTiling::of(set, {-20, 7, 40, 30}, options);
    ASSERT_TRUE(rows) << rows.error().message;
    Tiling made = tiled(set, 40, 30, options);
    for (int64_t y = 0; y < 30; ++y)
        for (int64_t x = 0; x < 40; ++x) {
            ASSERT_EQ(rows->at(x - 20, y + 7), made.at(uint32_t(x), uint32_t(y)));
            ASSERT_EQ(rows->at(x - 20 - 3 * 40, y + 7 + 2 * 30), made.at(uint32_t(x), uint32_t(y)));
        }
}

TEST(RowTiling, AsksForCornersWhereTheyAreOnThePlane) {
    TileSet set = corners_of_densities({0, 1});
    TilingOptions options;
    options.avoids_equal_neighbours = false;
    options.corner_at = [](int64_t x, int64_t y) { return uint8_t((x / 5 + y) & 1); };
    auto rows = RowTiling::of(set, {3, 11, 24, 16}, options);
    ASSERT_TRUE(rows) << rows.error().message;
    for (int64_t y = 11; y < 27; ++y)
        for (int64_t x = 3; x < 27; ++x)
            ASSERT_EQ(corners_of(set, set.tiles[rows->at(x, y)])[0], options.corner_at(x, y)) << x << " " << y;
}

TEST(RandomTiling, AgreesAtEveryEdgeAndIsTheSameInAnyOrder) {
    for (uint32_t tiles : {12u, 16u}) {
        TileSet set = set_of(tiles);
        auto random = RandomTiling::of(set, 9);
        ASSERT_TRUE(random) << random.error().message;
        EXPECT_EQ(random->block(), tiles == 16 ? 1u : 2u);
        Tiling tiling = window_of(*random, -151, -77, 300);
        EXPECT_EQ(count_neighbours(set, tiling).disagreeing, 0u);
        for (uint32_t i = 0; i < 1000; ++i) {
            uint32_t x = i * 7919 % 300, y = i * 104729 % 300;
            EXPECT_EQ(random->at(int64_t(x) - 151, int64_t(y) - 77), tiling.at(x, y));
        }
        auto other = RandomTiling::of(set, 10);
        EXPECT_FALSE(window_of(*other, -151, -77, 300).tiles == tiling.tiles);
        Tiling far = window_of(*random, int64_t(1) << 50, -(int64_t(1) << 50), 64);
        EXPECT_EQ(count_neighbours(set, far).disagreeing, 0u);
    }
}

TEST(RandomTiling, KeepsCorrelationUnderTwoHundredths) {
    for (uint32_t tiles : {12u, 16u}) {
        auto random = RandomTiling::of(set_of(tiles), 4);
        ASSERT_TRUE(random);
        EXPECT_LE(std::abs(greatest_correlation(window_of(*random, 0, 0, 512)).value), 0.02) << tiles;
    }
}

TEST(RandomTiling, NeverPutsAVariantBesideItself) {
    for (uint32_t variants : {2u, 3u, 4u, 5u}) {
        TileSet set = set_of(16, variants);
        auto random = RandomTiling::of(set, 5);
        ASSERT_TRUE(random);
        Tiling tiling = window_of(*random, -50, -50, 200);
        NeighbourCount count = count_neighbours(set, tiling);
        EXPECT_EQ(count.disagreeing + count.equal, 0u) << variants;
        std::set<uint8_t> used(tiling.tiles.begin(), tiling.tiles.end());
        EXPECT_EQ(used.size(), set.tiles.size());
        EXPECT_LE(std::abs(greatest_correlation(tiling).value), variants == 2 ? 0.04 : 0.02) << variants;
    }
}

TEST(RandomTiling, OfTooFewTilesIsRefused) {
    uint32_t refused = 0;
    for (const TileSet& set : {set_of(8), robinson_set()}) {
        auto random = RandomTiling::of(set, 1);
        if (random) continue;
        EXPECT_EQ(random.error().exit, Exit::impossible);
        EXPECT_NE(random.error().message.find("permits no random access"), std::string::npos);
        ++refused;
    }
    EXPECT_EQ(refused, 2u);
}

TEST(RandomTiling, OfTheDefaultSetWithBordersFollowsWhateverCornersAreAsked) {
    TileSet set = set_of(12, 1, true);
    CornerAt corner_at = [](int64_t x, int64_t y) { return uint8_t(hash_of(3, 1, x / 3, y / 2) % 3 == 0); };
    auto random = RandomTiling::of(set, 6, corner_at);
    ASSERT_TRUE(random) << random.error().message;
    EXPECT_EQ(random->block(), 2u);
    Tiling tiling = window_of(*random, -31, -64, 150);
    EXPECT_EQ(count_neighbours(set, tiling).disagreeing, 0u);
    for (uint32_t y = 0; y < 150; ++y)
        for (uint32_t x = 0; x < 150; ++x) {
            std::array<uint8_t, 4> corners = corners_of(set, set.tiles[tiling.at(x, y)]);
            for (uint32_t c = 0; c < 4; ++c)
                ASSERT_EQ(corners[c], corner_at(int64_t(x + (c & 1)) - 31, int64_t(y + (c >> 1)) - 64));
        }
    auto planted = RandomTiling::of(set, 6, [](int64_t, int64_t) { return uint8_t(0); });
    ASSERT_TRUE(planted);
    EXPECT_LE(std::abs(greatest_correlation(window_of(*planted, 0, 0, 512)).value), 0.02);
}

TEST(DensityMap, IsFollowedWithEveryEdgeMet) {
    TileSet set = corners_of_densities({1, 0.5f, 0});
    auto wanted = [](int64_t x, int64_t) { return double(x) / 200; };
    CornerAt corner_at = corners_of_density(set, wanted, 3);
    auto random = RandomTiling::of(set, 8, corner_at);
    ASSERT_TRUE(random) << random.error().message;
    Tiling tiling = window_of(*random, 0, 0, 201);
    EXPECT_EQ(count_neighbours(set, tiling).disagreeing, 0u);
    for (uint32_t band = 0; band < 10; ++band) {
        double sum = 0;
        for (uint32_t y = 0; y < 201; ++y)
            for (uint32_t x = 20 * band; x < 20 * band + 20; ++x)
                for (uint8_t corner : corners_of(set, set.tiles[tiling.at(x, y)])) sum += double(set.corner_density[corner]);
        EXPECT_NEAR(sum / (4 * 20 * 201), (20 * band + 10.0) / 200, 0.02) << band;
    }
}

TEST(DensityMap, UsesEveryColourOfADensitySoThatEvenGroundDoesNotRepeat) {
    for (const std::vector<float>& densities : {std::vector<float>{1, 1}, {1, 1, 0}, {0, 1, 1}}) {
        TileSet set = corners_of_densities(densities);
        auto even = RandomTiling::of(set, 4,
                                     corners_of_density(
                                         set, [](int64_t, int64_t) { return 1.0; }, 4));
        ASSERT_TRUE(even) << even.error().message;
        Tiling tiling = window_of(*even, -20, 7, 512);
        EXPECT_EQ(std::set<uint8_t>(tiling.tiles.begin(), tiling.tiles.end()).size(), 16u);
        EXPECT_LE(std::abs(greatest_correlation(tiling).value), 0.02);
        EXPECT_EQ(count_neighbours(set, tiling).disagreeing, 0u);
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
