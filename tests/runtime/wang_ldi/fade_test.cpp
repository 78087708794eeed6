// What gives way and what comes are whole together everywhere, change by little with little, and are what would be drawn without
// fades outside of the bands.
#include "runtime/wang_ldi/fade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace overlook::wang_ldi {
namespace {

// The paper's levels, for the first seven tiles of 2 m.
ImageSet paper_set() {
    ImageSet set;
    set.tile_m = 2, set.high_m = 1.8, set.tile_count = 8, set.direction_count = 8;
    float nearest = 1;
    for (uint32_t side : {468, 232, 151, 111, 88, 73, 62}) set.levels.push_back({side, nearest, 0.01f, 1}), nearest += 2;
    return set;
}
LadderOptions all_stages() {
    LadderOptions options;
    options.geometry_to_m = 2.5, options.texture_from_m = 40, options.texel_from_m = 32, options.texture_levels = 4;
    options.radius_m = 1200;
    return options;
}
// Shares of what is drawn at a distance, by stage and level.
std::map<std::pair<Stage, uint32_t>, uint32_t> shares_at(const Ladder& ladder, double distance_m) {
    Mix mix = rungs_at(ladder, distance_m);
    std::map<std::pair<Stage, uint32_t>, uint32_t> shares;
    auto add = [&](uint32_t rung, Thresholds thresholds) {
        if (thresholds.share() > 0) shares[{ladder.rungs[rung].stage, ladder.rungs[rung].level}] += thresholds.share();
    };
    add(mix.first, first_of(mix)), add(mix.second, second_of(mix));
    return shares;
}

TEST(Ladder, HasEveryStageInOrderAndNoBandsThatOverlap) {
    Ladder ladder = ladder_of(paper_set(), all_stages());
    ASSERT_EQ(ladder.rungs.size(), 1 + 7 + 4 + 2 + 1u);
    EXPECT_EQ(ladder.rungs.front().stage, Stage::geometry);
    EXPECT_EQ(ladder.rungs.back().stage, Stage::bare);
    for (size_t r = 1; r < ladder.rungs.size(); ++r) {
        const Rung &before = ladder.rungs[r - 1], &rung = ladder.rungs[r];
        EXPECT_LT(before.from_m, rung.from_m);
        EXPECT_LE(before.fade_to_m, rung.fade_from_m);
        EXPECT_LT(rung.fade_from_m, rung.from_m);
        EXPECT_LT(rung.from_m, rung.fade_to_m);
        EXPECT_LE(rung.fade_to_m - rung.fade_from_m, 0.2 * rung.from_m + 1e-9);
    }
}

// Textures and colours whose texels are a pixel wide or less.
TEST(Ladder, HalvesTexturesWithEveryDoublingOfTheDistance) {
    LadderOptions options = all_stages();
    options.radius_m = INFINITY;
    Ladder ladder = ladder_of(paper_set(), options);
    std::vector<double> from;
    for (const Rung& rung : ladder.rungs) {
        if (rung.stage != Stage::texture && rung.stage != Stage::colour) continue;
        EXPECT_EQ(rung.level, rung.stage == Stage::texture ? from.size() : from.size() - 3);
        from.push_back(rung.from_m);
    }
    ASSERT_GT(from.size(), 10u);
    EXPECT_EQ(from[0], 40);
    for (size_t n = 1; n < from.size(); ++n) EXPECT_EQ(from[n], 32 * std::exp2(n));
    EXPECT_GT(2 * from.back(), kFarthest_m);
}

TEST(Ladder, WithoutFadesIsTheLevelForEveryDistance) {
    ImageSet set = paper_set();
    LadderOptions options;
    options.fade_share = 0;
    Ladder ladder = ladder_of(set, options);
    for (double distance = 0; distance < 100; distance += 0.01) {
        Mix mix = rungs_at(ladder, distance);
        EXPECT_EQ(mix.first, mix.second);
        EXPECT_EQ(ladder.rungs[mix.first].level, level_for(set, distance)) << distance;
    }
}

TEST(Ladder, LeavesOutWhatHasNoRoom) {
    LadderOptions options = all_stages();
    options.geometry_to_m = 6, options.texture_from_m = 8, options.texel_from_m = 0.001, options.radius_m = 8.1;
    options.texture_levels = 1;
    Ladder ladder = ladder_of(paper_set(), options);
    std::vector<Stage> stages;
    for (const Rung& rung : ladder.rungs) stages.push_back(rung.stage);
    EXPECT_EQ(stages, (std::vector{Stage::geometry, Stage::ldi, Stage::ldi, Stage::colour, Stage::bare, Stage::ldi}));
    EXPECT_EQ(ladder.rungs[3].level, 12u);  // so wide is less than a pixel at 8 m
    EXPECT_EQ(ladder.rungs[1].level, 2u);
    EXPECT_EQ(ladder.rungs[1].from_m, 6);
    options = all_stages(), options.radius_m = 9.5;
    ladder = ladder_of(paper_set(), options);
    EXPECT_EQ(ladder.rungs[ladder.rungs.size() - 2].stage, Stage::bare);
    EXPECT_EQ(ladder.rungs[ladder.rungs.size() - 3].level, 4u);
}

// What is at hand whatever else is: of the coarsest level, shown at no distance by itself.
TEST(Ladder, HasTheCoarsestImagesToStandInForOthers) {
    for (double radius_m : {8.1, 9.5, 1000.0})
        for (double samples_from : {0.0, 300.0, 3000.0}) {
            LadderOptions options = all_stages();
            options.radius_m = radius_m, options.samples_from = samples_from;
            Ladder ladder = ladder_of(paper_set(), options);
            int of_coarsest = 0;
            for (size_t r = 0; r < ladder.rungs.size(); ++r) {
                if (ladder.rungs[r].stage != Stage::ldi || ladder.rungs[r].level + 1 != paper_set().levels.size()) continue;
                ++of_coarsest;
                if (!std::isinf(ladder.rungs[r].from_m)) continue;
                for (double distance_m = 0; distance_m < 1e7; distance_m = 1.01 * distance_m + 0.1) {
                    Mix mix = rungs_at(ladder, distance_m);
                    ASSERT_TRUE(mix.first != r && mix.second != r) << distance_m;
                }
            }
            EXPECT_EQ(of_coarsest, 1) << radius_m << " " << samples_from;
        }
}

TEST(Ladder, SharesAreWholeTogetherAndChangeByLittle) {
    Ladder ladder = ladder_of(paper_set(), all_stages());
    auto before = shares_at(ladder, 0);
    std::map<Stage, int> seen;
    for (double distance = 0; distance < 1500; distance *= 1.0001, distance += 1e-4) {
        auto shares = shares_at(ladder, distance);
        uint32_t sum = 0;
        for (auto [what, share] : shares) sum += share, ++seen[what.first];
        ASSERT_EQ(sum, kWhole);
        for (auto [what, share] : shares) {
            uint32_t was = before.contains(what) ? before[what] : 0;
            ASSERT_LE(std::max(share, was) - std::min(share, was), 2u) << distance;
        }
        before = shares;
    }
    EXPECT_EQ(seen.size(), 5u);
}

TEST(Directions, TheGreaterShareIsTheNearestDirections) {
    ImageSet set = paper_set();
    for (uint32_t count : {2u, 3u, 8u, 13u}) {
        set.direction_count = count;
        int mixed = 0;
        for (double heading = -10; heading < 370; heading += 0.05) {
            double angle = heading * M_PI / 180;
            glm::dvec2 eye(7 * std::sin(angle), 7 * std::cos(angle));
            Mix mix = directions_at(set, eye, 0.15);
            uint32_t nearest = direction_for(set, eye);
            mixed += mix.first != mix.second;
            if (mix.first == mix.second) {
                EXPECT_EQ(mix.first, nearest);
                continue;
            }
            EXPECT_EQ(mix.second, (mix.first + 1) % count);
            if (mix.second_share < kWhole / 2 - 1) {
                EXPECT_EQ(mix.first, nearest) << heading;
            }
            if (mix.second_share > kWhole / 2 + 1) {
                EXPECT_EQ(mix.second, nearest) << heading;
            }
            EXPECT_EQ(directions_at(set, eye, 0).first, nearest);
        }
        EXPECT_NEAR(mixed / 7600.0, 0.3, 0.02) << count;
    }
}

TEST(Directions, SharesChangeByLittleAllRound) {
    ImageSet set = paper_set();
    std::vector<uint32_t> before;
    for (double heading = 0; heading < 361; heading += 0.01) {
        double angle = heading * M_PI / 180;
        Mix mix = directions_at(set, {3 * std::sin(angle), 3 * std::cos(angle)}, 0.1);
        std::vector<uint32_t> shares(8, 0);
        shares[mix.first] += first_of(mix).share(), shares[mix.second] += second_of(mix).share();
        for (size_t d = 0; d < 8 && !before.empty(); ++d) ASSERT_LE(std::abs(int(shares[d]) - int(before[d])), 2) << heading;
        before = shares;
    }
}

// Wherever the finer image's pixels are let out, the coarser one's pixel there is shown, and the other way round.
TEST(Thresholds, OfTwoRungsExactlyOneIsShownAtEveryPixel) {
    for (uint32_t share : {1u, 60u, 128u, 255u}) {
        Mix mix{0, 1, share};
        uint64_t shown_by_finer = 0;
        for (uint32_t row = 0; row < 151; ++row)
            for (uint32_t column = 0; column < 151; ++column) {
                bool is_finer = first_of(mix).contains(rung_threshold(99, column, row, 151, 62));
                uint32_t coarse_column = (2 * column + 1) * 62 / 302, coarse_row = (2 * row + 1) * 62 / 302;
                ASSERT_LT(coarse_column, 62u);
                bool is_coarser = second_of(mix).contains(rung_threshold(99, coarse_column, coarse_row, 62, 62));
                ASSERT_NE(is_finer, is_coarser);
                shown_by_finer += is_finer;
            }
        EXPECT_NEAR(double(shown_by_finer) / (151 * 151), 1 - share / 256.0, 0.03);
    }
}

// What was shown by the second stays so while its share grows.
TEST(Thresholds, NothingTurnsBackWhileAShareGrows) {
    for (uint32_t value = 0; value < kWhole; ++value) {
        bool was_second = false;
        for (uint32_t share = 0; share <= kWhole; ++share) {
            bool is_second = second_of({0, 1, share}).contains(value);
            ASSERT_NE(is_second, first_of({0, 1, share}).contains(value));
            ASSERT_TRUE(is_second || !was_second);
            was_second = is_second;
        }
        ASSERT_TRUE(was_second);
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
