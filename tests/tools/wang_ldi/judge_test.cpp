// Views of a cell are spread evenly, and what is counted of them adds up.
#include "tools/bake/wang_ldi/judge.h"

#include <gtest/gtest.h>

#include "tests/tools/wang_ldi/plants.h"

namespace overlook::wang_ldi {
namespace {

TEST(JudgedViews, AreAsManyAsWereAskedForAndEvenlySpread) {
    ImageSet set = plants::image_set();
    set.tile_count = 5, set.context_count = 2;
    for (uint32_t all : {0u, 1u, 8u, 13u, 500u})
        for (uint32_t tiles : {1u, 3u, 5u}) {
            uint32_t sum = 0;
            std::vector<uint32_t> of_tile(set.tile_count), of_pair(set.levels.size() * set.direction_count);
            for (uint64_t i = 0; i < set.ldi_count(); ++i) {
                Which which = which_of(set, i);
                uint32_t views = views_of(set, which, all, tiles);
                EXPECT_TRUE(views == 0 || (which.context == 0 && which.tile < tiles));
                sum += views, of_tile[which.tile] += views, of_pair[which.level * set.direction_count + which.direction] += views;
            }
            EXPECT_EQ(sum, all);
            auto [least, most] = std::minmax_element(of_pair.begin(), of_pair.end());
            EXPECT_LE(*most - *least, 1u);
            auto [few, many] = std::minmax_element(of_tile.begin(), of_tile.begin() + tiles);
            EXPECT_LE(*many - *few, 1 + of_pair.size()) << all;
        }
}

TEST(Shares, GiveTheValueThatAShareDoesNotExceed) {
    Shares shares;
    EXPECT_EQ(shares.percentile(0.99), 0);
    for (int i = 0; i < 1000; ++i) shares.add(i / 1000.0);
    EXPECT_NEAR(shares.percentile(0.5), 0.5, 1.0 / Shares::kSteps);
    EXPECT_NEAR(shares.percentile(0.99), 0.99, 1.0 / Shares::kSteps);
    Shares twice = shares;
    twice.add(shares);
    EXPECT_EQ(twice.percentile(0.3), shares.percentile(0.3));
    twice.add(1), twice.add(-1), twice.add(7);
    EXPECT_EQ(twice.counts[0] + twice.counts[Shares::kSteps - 1], 2 * (shares.counts[0] + shares.counts[Shares::kSteps - 1]) + 3);
}

// A board across the tile, as an image with every second of its samples: half of it are holes, one pixel wide, and filled.
TEST(Judgements, CountHolesBeforeAndAfterTheyAreFilled) {
    Models models;
    models.meshes.resize(1), models.skins.resize(1);
    plants::add_triangle(models.meshes[0], {0, 2, 0}, {4, 2, 0}, {4, 2, 1});
    plants::add_triangle(models.meshes[0], {0, 2, 0}, {4, 2, 1}, {0, 2, 1});
    auto stage = stage_of(models, {{0, glm::mat4x3(1)}}, 1u << 30);
    ASSERT_TRUE(stage);
    ImageSet set = plants::image_set();
    set.tile_count = 1, set.cell.focal_px = 240, set.has_normals = true;  // so that its colour is its own
    set.levels = {{160, 6, 0.006f, 1}};
    set.cell.nearest_m = 6, set.cell.farthest_m = 6, set.levels[0].nearest_m = 6;
    Ldi whole, holed;
    for (Ldi* ldi : {&whole, &holed}) {
        ldi->side_px = 160, ldi->first = {0}, ldi->palette = {{255, 255, 255}};
        for (uint32_t p = 0; p < 160 * 160; ++p) {
            for (uint16_t k = 0; p / 160 == 80 && k < 42; ++k)
                if (ldi == &whole || (p + k) % 2 == 0) ldi->heights.push_back(uint16_t(4 * k)), ldi->colours.push_back(0);
            ldi->first.push_back(uint32_t(ldi->heights.size()));
        }
    }
    Judging judging;
    judging.views = 6, judging.size_px = 64;
    Judgement full = judged(models, *stage, set, {0, 0, 0, 0}, whole, {}, judging),
              half = judged(models, *stage, set, {0, 0, 0, 0}, holed, {}, judging);
    ASSERT_GT(full.pixels, 500u);
    EXPECT_EQ(full.pixels, half.pixels);
    EXPECT_LE(full.holes_left, full.holes);
    EXPECT_LT(half.holes_left, half.holes);
    EXPECT_GT(half.holes, full.holes + half.pixels / 10);
    EXPECT_GT(half.unfilled_error_sum, full.unfilled_error_sum);
    EXPECT_GT(half.unfilled_error_sum, half.error_sum);
    EXPECT_GE(half.p99_error(), half.mean_error());
    Judgement both = full;
    both.add(half);
    EXPECT_EQ(both.holes, full.holes + half.holes);
    EXPECT_EQ(both.error_pixels, full.error_pixels + half.error_pixels);
}

}  // namespace
}  // namespace overlook::wang_ldi
