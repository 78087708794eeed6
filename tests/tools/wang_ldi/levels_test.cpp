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
                EXPECT_LE(double(level.height_step_m), 1.0001 * std::max(pixel_m / 2, 4e-5));
                EXPECT_GE(double(level.height_step_m), 0.9999 * pixel_m / 2);
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

TEST(Levels, AreFineEnoughFromWhereTheyFadeIn) {
    LevelOptions options;
    options.set = plants::image_set();
    auto plain = leveled(options);
    options.set.level_fade = 0.125f;
    auto faded = leveled(options);
    ASSERT_TRUE(plain && faded);
    for (const Level& level : faded->levels)
        EXPECT_LE(4.0 / level.side_px * 400 / nearest_of_tile_m(*faded, 0.875 * double(level.nearest_m)), 1.0001);
    EXPECT_GT(faded->levels[0].side_px, plain->levels[0].side_px);
    options.set.cell.nearest_m = 3.2;  // fades in within the tile
    auto within = leveled(options);
    ASSERT_FALSE(within);
    EXPECT_NE(within.error().message.find("2.8 m from the eye, within a tile of 4 m; --nearest-m 3.25 at least"),
              std::string::npos)
        << within.error().message;
}

// The farthest that any point of a tile's rim moves in the picture of an eye that looks at the tile's middle, when the eye goes
// round it: tried out.
double tried_turn_px(double rim_m, double distance_m, double turn_rad, double focal_px) {
    double most_px = 0;
    auto place_px = [&](double angle) { return focal_px * rim_m * std::sin(angle) / (distance_m - rim_m * std::cos(angle)); };
    for (int i = 0; i < 20000; ++i) {
        double angle = 2 * M_PI * i / 20000;
        most_px = std::max(most_px, std::abs(place_px(angle + turn_rad) - place_px(angle)));
    }
    return most_px;
}

TEST(Directions, RimTurnIsNoLessThanThatOfAnyPointOfIt) {
    for (double distance_m : {2.9, 3.5, 6.0, 10.0, 80.0})
        for (double turn_rad : {0.05, 0.1, 0.4, 0.9, 1.6, 3.14159}) {
            double tried_px = tried_turn_px(2.83, distance_m, turn_rad, 400);
            EXPECT_GE(rim_turn_px(2.83, distance_m, turn_rad, 400), tried_px * (1 - 1e-9)) << distance_m << " " << turn_rad;
            double reach = 2 * std::acos(2.83 / distance_m);
            if (turn_rad < reach) {
                EXPECT_LE(rim_turn_px(2.83, distance_m, turn_rad, 400), tried_px * 1.001);
            }
        }
}

TEST(Directions, AreTheFewestThatKeepTheBudgetAtTheNearRim) {
    for (float fade : {0.0f, 0.1f})
        for (double budget_px : {30.0, 60.0, 170.0}) {
            LevelOptions options;
            options.set = plants::image_set(), options.set.direction_fade = fade, options.direction_px = budget_px;
            auto set = leveled(options);
            ASSERT_TRUE(set) << set.error().message;
            uint32_t n = set->direction_count;
            ASSERT_GT(n, 3u);
            double half_rad = M_PI * (1 + 2 * double(fade));
            EXPECT_LE(tried_turn_px(4 / std::sqrt(2.0), 6, half_rad / n, 400), budget_px);
            EXPECT_GT(tried_turn_px(4 / std::sqrt(2.0), 6, half_rad / (n - 1), 400), budget_px * 0.999);
        }
    LevelOptions options;
    options.set = plants::image_set(), options.direction_px = 1e5;
    EXPECT_EQ(leveled(options)->direction_count, 1u);
}

TEST(Directions, MoreThanAreDrawnAreRefusedWithAWayOut) {
    LevelOptions options;
    options.set = plants::image_set(), options.direction_px = 5;
    auto set = leveled(options);
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().exit, Exit::bad_command);
    std::string text = set.error().message;
    size_t at = text.find("--direction-px ");
    ASSERT_NE(at, std::string::npos) << text;
    options.direction_px = std::stod(text.substr(at + 15));
    auto enough = leveled(options);
    ASSERT_TRUE(enough) << enough.error().message;
    EXPECT_EQ(enough->direction_count, kMostDirections);
}

}  // namespace
}  // namespace overlook::wang_ldi
