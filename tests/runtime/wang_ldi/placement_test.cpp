// Where tiles are planted is what the rules say, place by place; edges end bare; and nothing is kept.
#include "runtime/wang_ldi/placement.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/runtime/wang_ldi/field_ground.h"

namespace overlook::wang_ldi {
namespace {

const Ground& holed_hills() {
    static const terrain::Terrain terrain = terrain_of(
        101, 101, 10, 10, [](uint32_t column, uint32_t row) { return column == 60 && row == 40 ? NAN : hill_m(column, row); });
    static const Ground ground(terrain);
    return ground;
}
Placement placement_of(const Ground& ground, double tile_m, const PlacementOptions& options) {
    auto placement = Placement::of(ground, tile_m, options);
    EXPECT_TRUE(placement) << placement.error().message;
    return std::move(*placement);
}
// White where `is_white(column, row)`.
ImageRgb8 picture_of(uint32_t width, uint32_t height, const std::function<double(uint32_t, uint32_t)>& white_at) {
    ImageRgb8 picture{width, height, {}};
    for (uint32_t row = 0; row < height; ++row)
        for (uint32_t column = 0; column < width; ++column)
            picture.pixels.insert(picture.pixels.end(), 3, uint8_t(std::lround(255 * white_at(column, row))));
    return picture;
}
// Corners of two colours, the second bare, with a tile for every four edges.
TileSet set_with_bare_corners() {
    TileSet set;
    set.horizontal = set.vertical = {{0, 0}, {0, 1}, {1, 0}, {1, 1}}, set.corner_density = {1, 0};
    for (uint8_t sw = 0; sw < 2; ++sw)
        for (uint8_t se = 0; se < 2; ++se)
            for (uint8_t nw = 0; nw < 2; ++nw)
                for (uint8_t ne = 0; ne < 2; ++ne)
                    set.tiles.push_back({uint8_t(nw * 2 + ne), uint8_t(se * 2 + ne), uint8_t(sw * 2 + se), uint8_t(sw * 2 + nw)});
    return set;
}

TEST(Placement, EveryPlaceOfAPlantedTileKeepsTheRules) {
    PlacementOptions options;
    options.lowest_m = 105, options.highest_m = 140, options.steepest = 0.22;
    Placement placement = placement_of(holed_hills(), 7, options);
    std::array<int, kVerdicts> seen{};
    for (int64_t j = -145; j < 5; ++j)
        for (int64_t i = -5; i < 145; ++i) {
            Verdict verdict = placement.verdict(i, j);
            ++seen[size_t(verdict)];
            Rect rect = placement.rect_of(i, j);
            double low = INFINITY, high = -INFINITY;
            bool is_there = holed_hills().extent().contains(rect);
            for (int place = 0; place < 64 && is_there; ++place) {
                double height = holed_hills().height_m(rect.low_m + glm::dvec2(place % 8, place / 8));
                low = std::min(low, height), high = std::max(high, height), is_there = !std::isnan(height);
            }
            if (verdict == Verdict::planted) {
                ASSERT_TRUE(is_there && low >= 105 && high <= 140);
                ASSERT_LE(holed_hills().range(rect).steepest, 0.22);
            } else if (is_there && verdict != Verdict::no_ground) {  // the rule that is told is broken somewhere in it
                double slack = 7.0 / 7 * holed_hills().range(rect).steepest;
                ASSERT_TRUE(verdict != Verdict::too_low || low < 105 + slack);
                ASSERT_TRUE(verdict != Verdict::too_high || high > 140 - slack);
                ASSERT_TRUE(verdict != Verdict::too_steep || holed_hills().range(rect).steepest > 0.22);
            }
        }
    for (Verdict verdict : {Verdict::planted, Verdict::no_ground, Verdict::too_low, Verdict::too_high, Verdict::too_steep})
        EXPECT_GT(seen[size_t(verdict)], 20) << int(verdict);
}

TEST(Placement, FollowsAPaintedMask) {
    Ground ground = holed_hills();
    PlacementOptions options;
    options.steepest = INFINITY;
    options.mask = picture_of(100, 50, [](uint32_t column, uint32_t row) { return column < 30 && row >= 25 ? 1.0 : 0.0; });
    Placement placement = placement_of(ground, 4, options);
    int planted = 0;
    for (int64_t j = -250; j < 0; ++j)
        for (int64_t i = 0; i < 250; ++i) {
            bool is_inside = 4 * i + 2 < 300 && 4 * j + 2 < -500;
            if (std::abs(4 * i + 2 - 300) < 10 && std::abs(4 * j + 2 + 500) < 20) continue;  // the corner is round
            ASSERT_EQ(placement.is_planted(i, j), is_inside) << i << " " << j;
            planted += is_inside;
        }
    EXPECT_GT(planted, 75 * 125 - 20);
}

TEST(Placement, WhatIsSaidOfARectangleHoldsOfEveryTileInIt) {
    PlacementOptions options;
    options.lowest_m = 100, options.highest_m = 150, options.steepest = 0.3;
    options.mask = picture_of(64, 64, [](uint32_t column, uint32_t row) { return (column / 16 + row / 16) % 3 ? 1.0 : 0.0; });
    Placement placement = placement_of(holed_hills(), 5, options);
    std::mt19937 random(8);
    std::array<int, 3> seen{};
    for (int n = 0; n < 2000; ++n) {
        int64_t tiles = 1 + random() % 12, i = int64_t(random() % 210) - 5, j = -int64_t(random() % 210);
        auto coverage = placement.coverage(placement.rect_of(i, j, tiles));
        ++seen[size_t(coverage)];
        if (coverage == Placement::Coverage::some) continue;
        for (int64_t y = j; y < j + tiles; ++y)
            for (int64_t x = i; x < i + tiles; ++x) ASSERT_EQ(placement.is_planted(x, y), coverage == Placement::Coverage::all);
    }
    for (int count : seen) EXPECT_GT(count, 50);
}

TEST(Placement, AtItsEdgeAreTilesWithAnUnplantedNeighbour) {
    PlacementOptions options;
    options.highest_m = 135;
    Placement placement = placement_of(holed_hills(), 6, options);
    int edges = 0, inner = 0;
    for (int64_t j = -150; j < -20; ++j)
        for (int64_t i = 10; i < 150; ++i) {
            if (!placement.is_planted(i, j)) continue;
            bool is_edge = false;
            for (int n = 0; n < 9; ++n) is_edge |= !placement.is_planted(i + n % 3 - 1, j + n / 3 - 1);
            ASSERT_EQ(placement.is_at_edge(i, j), is_edge);
            (is_edge ? edges : inner)++;
        }
    EXPECT_GT(edges, 100);
    EXPECT_GT(inner, 1000);
}

// A tile that has a planted corner stands where the rules allow it, and so do all that share the corner.
TEST(Placement, FairedEdgesEndWithBareCorners) {
    TileSet set = set_with_bare_corners();
    PlacementOptions options;
    options.highest_m = 135;
    Placement placement = placement_of(holed_hills(), 6, options);
    auto tiling = RandomTiling::of(set, 5, placement.corners(set, 5));
    ASSERT_TRUE(tiling) << tiling.error().message;
    int whole = 0, partial = 0, bare = 0;
    for (int64_t j = -165; j < 0; ++j)
        for (int64_t i = 0; i < 165; ++i) {
            auto corners = corners_of(set, set.tiles[tiling->at(i, j)]);
            int planted = 0;
            for (int64_t c = 0; c < 4; ++c) {
                planted += corners[size_t(c)] == 0;
                bool is_allowed = true;
                for (int64_t n = 0; n < 4; ++n) is_allowed &= placement.is_planted(i + c % 2 - n % 2, j + c / 2 - n / 2);
                ASSERT_EQ(corners[size_t(c)] == 0, is_allowed);
            }
            if (planted > 0) {
                ASSERT_TRUE(placement.is_planted(i, j));
            }
            (planted == 4 ? whole : planted == 0 ? bare : partial)++;
        }
    EXPECT_GT(whole, 1000);
    EXPECT_GT(partial, 100);
    EXPECT_GT(bare, 1000);
}

TEST(Placement, DensityFallsToNothingOverTheTilesAskedFor) {
    Ground ground = holed_hills();
    PlacementOptions options;
    options.steepest = INFINITY, options.fairing_tiles = 4;
    options.mask = picture_of(100, 50, [](uint32_t column, uint32_t) { return column < 30 ? 1.0 : 0.0; });
    Placement placement = placement_of(ground, 5, options);
    for (int64_t i = 5; i < 100; ++i) {
        double tiles_inside = std::clamp(60.0 - double(i), 0.0, 4.0);  // the mask ends at tile 60
        EXPECT_DOUBLE_EQ(placement.corner_density(i, -150), tiles_inside / 4) << i;
    }
}

TEST(Placement, CornersAreAsOftenPlantedAsTheDensityMapSays) {
    TileSet set = set_with_bare_corners();
    PlacementOptions options;
    options.steepest = INFINITY, options.fairing_tiles = 0;
    options.density = picture_of(40, 40, [](uint32_t column, uint32_t) { return column < 20 ? 0.25 : 0.75; });
    Placement placement = placement_of(holed_hills(), 2, options);
    CornerAt corner_at = placement.corners(set, 77);
    double west = 0, east = 0;
    for (int64_t j = -400; j < -200; ++j)
        for (int64_t i = 0; i < 200; ++i) west += corner_at(i, j) == 0, east += corner_at(i + 270, j) == 0;
    EXPECT_NEAR(west / 40000, 0.25, 0.01);
    EXPECT_NEAR(east / 40000, 0.75, 0.01);
}

TEST(Placement, RefusesRulesThatMakeNoSense) {
    PlacementOptions options;
    options.lowest_m = 500, options.highest_m = 200;
    auto refused = Placement::of(holed_hills(), 2, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().exit, Exit::bad_command);
    EXPECT_EQ(refused.error().message, "planting from 500 m up to 200 m: no height lies between");
    options = {}, options.steepest = NAN;
    EXPECT_FALSE(Placement::of(holed_hills(), 2, options));
    options = {}, options.fairing_tiles = 9;
    EXPECT_FALSE(Placement::of(holed_hills(), 2, options));
    options = {}, options.mask.width = options.mask.height = 3;
    EXPECT_FALSE(Placement::of(holed_hills(), 2, options));
    EXPECT_FALSE(Placement::of(holed_hills(), 0, {}));
}

}  // namespace
}  // namespace overlook::wang_ldi
