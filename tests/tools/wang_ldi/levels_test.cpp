// Levels begin where a pixel of theirs is as wide on the screen as was asked, the paper's are the paper's, and a wedge turns the
// tile's rim by no more than its budget.
#include "tools/bake/wang_ldi/levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/wang_ldi/plants.h"

namespace overlook::wang_ldi {
namespace {

TEST(Levels, OfThePaperAreThePapers) {
    LevelOptions options;
    options.constants = Constants::paper, options.set = plants::image_set();
    auto set = leveled(options);
    ASSERT_TRUE(set);
    std::vector<uint32_t> sides;
    for (const Level& level : set->levels) sides.push_back(level.side_px);
    EXPECT_EQ(sides, (std::vector<uint32_t>{468, 232, 151, 111, 88, 73, 62}));
    EXPECT_EQ(set->direction_count, 8u);
}

TEST(Levels, BeginWhereAPixelIsAsWideAsTheErrorAsked) {
    for (double error_px : {0.5, 1.0, 3.0})
        for (double high_m : {0.5, 1.0, 2.5}) {
            LevelOptions options;
            options.set = plants::image_set();
            options.set.cell.error_px = error_px, options.set.high_m = high_m;
            auto set = leveled(options);
            ASSERT_TRUE(set) << set.error().message;
            ASSERT_GE(set->levels.size(), 3u);
            EXPECT_EQ(double(set->levels[0].nearest_m), 6);
            for (size_t k = 0; k < set->levels.size(); ++k) {
                const Level& level = set->levels[k];
                double pixel_m = 4.0 / level.side_px, nearest_m = nearest_of_tile_m(*set, double(level.nearest_m));
                EXPECT_LE(pixel_m * 400 / nearest_m, error_px * 1.0001);
                EXPECT_GT(pixel_m * 400 / nearest_m, error_px * 0.8 * (1 - 1.0 / level.side_px));
                EXPECT_LE(double(level.height_step_m), 1.0001 * std::max(pixel_m / 4, 4e-5));
                EXPECT_GE(set->low_m + 65535 * double(level.height_step_m), high_m);
            }
        }
}

TEST(Levels, ThatNobodyCanHaveAreRefusedWithAWayOut) {
    LevelOptions options;
    options.set = plants::image_set();
    options.set.cell.nearest_m = 2.5;
    auto inside = leveled(options);
    ASSERT_FALSE(inside);
    EXPECT_EQ(inside.error().exit, Exit::bad_command);
    EXPECT_EQ(
        inside.error().message,
        "tiles begin at 2.5 m from the eye, within a tile of 4 m; --nearest-m 2.84 at least, nearer ones are drawn as geometry");
    options.set.cell.nearest_m = 6, options.set.cell.error_px = 0.01;
    auto fine = leveled(options);
    ASSERT_FALSE(fine);
    EXPECT_NE(fine.error().message.find("4,096 are possible"), std::string::npos) << fine.error().message;
}

TEST(Levels, OfOneDistanceAreOneAsFineAsElsewhere) {
    LevelOptions options;
    options.set = plants::image_set();
    auto many = leveled(options);
    options.set.cell.farthest_m = options.set.cell.nearest_m;
    auto one = leveled(options);
    ASSERT_TRUE(many && one);
    ASSERT_EQ(one->levels.size(), 1u);
    EXPECT_EQ(one->levels[0].side_px, many->levels[0].side_px);
    EXPECT_GT(one->levels[0].side_px, 100u);
    options.set.cell = {1.5, 1.9, 0, 5, 400, 1};  // 10 m by default
    auto none = leveled(options);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().exit, Exit::bad_command);
    EXPECT_NE(none.error().message.find("5 m from the eye at most, 10 m at least"), std::string::npos) << none.error().message;
}

TEST(Directions, AreTheFewestThatKeepTheBudget) {
    for (double radius : {10.0, 95.0, 97.0, 250.0, 500.0}) {
        uint32_t n = directions_for(radius, 96);
        double turn = n < 3 ? radius : radius * std::sin(M_PI / n), before = n <= 3 ? radius : radius * std::sin(M_PI / (n - 1));
        EXPECT_LE(turn, 96);
        EXPECT_TRUE(n == 1 || before > 96) << n;
    }
    EXPECT_EQ(directions_for(10, 96), 1u);
    EXPECT_EQ(directions_for(250, 96), 8u);
    EXPECT_EQ(directions_for(1e9, 96), kMostDirections);
}

}  // namespace
}  // namespace overlook::wang_ldi
