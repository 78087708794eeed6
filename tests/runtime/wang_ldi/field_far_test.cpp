// Fields to the horizon: what they cost, what gives way to what, where the ground is not even, and that nothing of a world is
// kept.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "runtime/wang_ldi/field.h"
#include "tests/runtime/wang_ldi/field_ground.h"
#include "tests/runtime/wang_ldi/field_parts.h"

namespace overlook::wang_ldi {
namespace {

TEST(FarField, AThousandTilesCostNoMoreThanTwiceForty) {
    TestField test{Ground::plain()};
    for (double pitch : {-20.0, -5.0, 3.0}) {
        view::Camera camera = head_camera({0.7, 0.9, 1.7}, 50, pitch);
        FieldOptions options = test.to_horizon();
        auto counts_within = [&](double tiles) {
            options.ladder.radius_m = tiles * test.images.tile_m;
            return list_of(test.field(options), camera).counts;
        };
        FieldCounts forty = counts_within(40), thousand = counts_within(1000), horizon = counts_within(1e6);
        EXPECT_LE(thousand.cost(), 2 * forty.cost());
        EXPECT_LE(thousand.tiles_listed + thousand.blocks_listed, 2 * (forty.tiles_listed + forty.blocks_listed));
        EXPECT_LE(horizon.cost(), 3 * forty.cost());
        EXPECT_GT(thousand.texels, forty.texels);
        RecordProperty("forty", std::to_string(forty.cost()));
        RecordProperty("thousand", std::to_string(thousand.cost()));
        RecordProperty("horizon", std::to_string(horizon.cost()));
        std::string name = "paper" + std::to_string(int(pitch));
        RecordProperty(name, std::to_string(list_of(test.field(paper_options(test.images)), camera).counts.cost()));
    }
}

// The same where levels themselves go on with 1 / distance to 40 tiles: cheaper than the paper's, which stop at the seventh.
TEST(FarField, LevelsThatGoOnCostLessThanThePapersSeven) {
    TestField test{Ground::plain()}, on{Ground::plain()};
    on.images.cell.farthest_m = 80;
    for (uint32_t tiles : {10, 14, 20, 28, 40}) on.images.levels.push_back({434 / tiles, 2.0f * float(tiles), 0.01f, 1});
    on.sample_counts.clear();
    for (uint64_t i = 0; i < on.images.ldi_count(); ++i) {
        uint32_t side = on.images.levels[which_of(on.images, i).level].side_px;
        on.sample_counts.push_back(4 * side * side);
    }
    view::Camera camera = head_camera({0.7, 0.9, 1.7}, 50);
    FieldOptions options = on.to_horizon();
    EXPECT_EQ(options.ladder.texture_from_m, 80);
    options.ladder.radius_m = 80;
    uint64_t paper = list_of(test.field(paper_options(test.images)), camera).counts.cost();
    uint64_t forty = list_of(on.field(options), camera).counts.cost();
    options.ladder.radius_m = 2000;
    uint64_t thousand = list_of(on.field(options), camera).counts.cost();
    EXPECT_LT(forty, paper * 3 / 4);
    EXPECT_LE(thousand, 2 * forty);
    RecordProperty("on_forty", std::to_string(forty)), RecordProperty("on_thousand", std::to_string(thousand));
}

// What an item shows, by the areas of its thresholds, is all of it; where nothing fades into bareness. Of geometry and the images
// that it gives way to, one is all of it.
TEST(FarField, SharesOfEveryItemAreWhole) {
    TestField test{Ground(hills())};
    Field field = test.field(test.to_horizon(4));
    std::map<Stage, int> seen;
    int with_four = 0, with_both = 0;
    for (double heading = 0; heading < 360; heading += 45) {
        FieldList list = list_of(field, head_camera({601.1, -530.3, test.ground.height_m({601.1, -530.3}) + 1.7}, heading));
        for (const Item& item : list.items) {
            if (item.tiles_log2 > 0) continue;
            std::map<Stage, uint32_t> shares;
            for (const Shown& shown : list.shown_of(item)) {
                Stage stage = field.ladder().rungs[shown.rung].stage;
                shares[stage] += shown.by_rung.share() * shown.by_direction.share();
                ++seen[stage];
            }
            if (shares.contains(Stage::geometry) && shares.size() > 1) {
                ++with_both;
                ASSERT_EQ(std::max(shares[Stage::geometry], shares[Stage::ldi]), kWhole * kWhole);
                continue;
            }
            uint32_t whole = 0;
            for (const auto& [unused, share] : shares) whole += share;
            ASSERT_EQ(whole, kWhole * kWhole);
            for (uint32_t rung = 0; rung < kWhole; rung += 5)
                for (uint32_t direction = 0; direction < kWhole; direction += 5) {
                    int count = 0;
                    for (const Shown& shown : list.shown_of(item))
                        count += shown.by_rung.contains(rung) && shown.by_direction.contains(direction);
                    ASSERT_EQ(count, 1);
                }
            with_four += item.shown_count == 4;
        }
    }
    EXPECT_GT(seen[Stage::geometry], 10);
    EXPECT_GT(seen[Stage::ldi], 500);
    EXPECT_GT(seen[Stage::texture], 100);
    EXPECT_GT(with_four, 10);
    EXPECT_GT(with_both, 2);
}

// Near the eye geometry, then images, textures, and colours last: each stage begins where the one before has ended or fades out.
TEST(FarField, StagesFollowOneAnotherToTheHorizon) {
    TestField test{Ground::plain()};
    Field field = test.field(test.to_horizon(4));
    FieldList list = list_of(field, head_camera({0, 0, 1.7}, 10));
    std::map<Stage, std::pair<double, double>> reach;
    for (const Item& item : list.items)
        for (const Shown& shown : list.shown_of(item)) {
            auto [at, is_new] = reach.try_emplace(field.ladder().rungs[shown.rung].stage, item.distance_m, item.distance_m);
            at->second = {std::min(at->second.first, item.distance_m), std::max(at->second.second, item.distance_m)};
        }
    EXPECT_EQ(reach.size(), 3u);
    EXPECT_LE(reach[Stage::geometry].second, 4 * 1.1);
    EXPECT_GE(reach[Stage::ldi].first, 4 * 0.9);
    EXPECT_LE(reach[Stage::ldi].second, 1.1 * field.options().ladder.texture_from_m);
    EXPECT_GE(reach[Stage::texture].first, 0.9 * field.options().ladder.texture_from_m);
    double farthest_m = 0;
    for (const Item& item : list.items)
        if (item.tiles_log2 > 0) {
            ASSERT_EQ(item.shown_count, 0u);
            const Rung& last = field.ladder().rungs[item.last_rung];
            ASSERT_TRUE(last.stage == Stage::texture || last.stage == Stage::colour);
            farthest_m = std::max(farthest_m, item.distance_m);
            double side_m = 2.0 * double(int64_t(1) << item.tiles_log2);
            ASSERT_LE(side_m, 0.25 * item.distance_m);
            // Texels no wider than a pixel, and hardly more than twice as fine, unless the texture has no more.
            double wide_px = 415.7 * side_m / item.distance_m / item.texels_px;
            ASSERT_LE(wide_px, item.texels_px == 32u << item.tiles_log2 ? 1.4 : 1.001);
            ASSERT_GT(wide_px, 0.25);
        }
    EXPECT_GT(farthest_m, 1e6);
}

TEST(FarField, TilesAreCutUntilTheyStandOnTheGroundOrAreCounted) {
    terrain::Terrain rough = terrain_of(400, 400, 1.5, 1.5, [](uint32_t column, uint32_t row) {
        return hill_m(column * 0.15, row * 0.15) + 0.3 * std::sin(column * 1.3) * std::sin(row * 1.1);
    });
    TestField test{Ground(rough)};
    FieldOptions options = test.to_horizon();
    options.displacement_px = 2;
    Field field = test.field(options);
    view::Camera camera = head_camera({300, -300, test.ground.height_m({300, -300}) + 1.7}, 200);
    FieldList list = list_of(field, camera);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(0, 1);
    uint64_t cut = 0, pieces = 0, most = 0;
    for (const Item& item : list.items) {
        if (item.half_count == 0) continue;
        uint32_t side = 1u << item.pieces_log2;
        ASSERT_EQ(item.half_count, 2 * side * side);
        cut += side > 1, pieces += side * side, most += item.pieces_log2 == 2;
        Rect rect = test.placement->rect_of(item.i, item.j);
        for (int n = 0; n < 50; ++n) {
            glm::dvec2 share(unit(random), unit(random)), in_piece = glm::fract(share * double(side));
            glm::uvec2 piece(share * double(side));
            for (const Half& half : list.halves_of(item)) {
                if (half.column != piece.x || half.row != piece.y) continue;
                if (half.half != half_of(half.diagonal, in_piece.x, in_piece.y)) continue;
                double plane_m = half.plane.height_m + glm::dot(half.plane.slope, 2.0 * share);
                ASSERT_LE(std::abs(test.ground.height_m(rect.low_m + 2.0 * share) - plane_m), item.displacement_m + 1e-9);
            }
        }
        // Each piece stands on the ground at its corners, so pieces and tiles leave no gaps.
        const Half& first = list.halves_of(item)[0];
        glm::dvec2 corner = 2.0 / side *
                            (glm::dvec2(first.column, first.row) +
                             glm::dvec2(first.half, first.diagonal == Diagonal::rising ? 1 - first.half : first.half));
        EXPECT_NEAR(first.plane.height_m + glm::dot(first.plane.slope, corner), test.ground.height_m(rect.low_m + corner), 1e-9);
    }
    EXPECT_EQ(list.counts.cut_tiles, cut);
    EXPECT_EQ(list.counts.pieces, pieces);
    EXPECT_GT(cut, 50u);
    EXPECT_GT(most, 0u);
    EXPECT_LT(cut, list.counts.tiles_listed);
    EXPECT_TRUE(list.counts.displaced_tiles > 0 || list.counts.displacement_px <= 2);
    options.displacement_px = INFINITY;
    EXPECT_EQ(list_of(test.field(options), camera).counts.cut_tiles, 0u);
}

TEST(FarField, TooSteepTilesAreNotDrawnButCounted) {
    PlacementOptions planting;
    planting.steepest = 0.15;
    TestField test(Ground(hills()), planting);
    Field field = test.field(test.to_horizon());
    uint64_t steep = 0, listed = 0;
    for (int view = 0; view < 12; ++view) {
        glm::dvec2 at(300 + 50 * view, -500);
        FieldList list = list_of(field, head_camera({at, test.ground.height_m(at) + 1.7}, 30.0 * view, -15));
        steep += list.counts.tiles_by_verdict[size_t(Verdict::too_steep)], listed += list.counts.tiles_listed;
        for (const Item& item : list.items) {
            if (item.tiles_log2 > 0) continue;
            ASSERT_LE(test.ground.range(test.placement->rect_of(item.i, item.j)).steepest, 0.15);
        }
    }
    EXPECT_GT(steep, 100u);
    EXPECT_GT(listed, 100u);
}

TEST(FarField, BordersAreDrawnByImagesWithoutContext) {
    PlacementOptions planting;
    planting.highest_m = 140;
    TestField test(Ground(hills()), planting, 2);
    Field field = test.field(test.to_horizon());
    int edges = 0, inner = 0;
    for (int view = 0; view < 40; ++view) {
        glm::dvec2 at(200 + 20 * view, -300);
        for (const Item& item : list_of(field, head_camera({at, test.ground.height_m(at) + 1.7}, 37.0 * view, -15)).items) {
            if (item.tiles_log2 > 0) continue;
            ASSERT_EQ(item.context, test.placement->is_at_edge(item.i, item.j));
            (item.context ? edges : inner)++;
        }
    }
    EXPECT_GT(inner, 100);
    EXPECT_GT(edges, 5);
}

TEST(FarField, OutsideOfTheCellIsSaid) {
    TestField test{Ground::plain()};
    Field field = test.field(test.to_horizon());
    EXPECT_EQ(list_of(field, head_camera({1, -3, 1.7}, 0, -25)).counts.displaced_tiles, 0u);
    FieldList risen = list_of(field, head_camera({1, -3, 12}, 0, -25));
    uint64_t with_images = 0;
    for (const Item& item : risen.items) {
        with_images += item.half_count > 0;
        ASSERT_EQ(item.is_outside_cell, item.half_count > 0);
        // From 9.5 m above where they were sampled from, images are as fine as for 9.5 m away at most.
        ASSERT_GE(item.distance_m, 9.5);
    }
    EXPECT_GT(with_images, 50u);
    EXPECT_EQ(risen.counts.outside_cell, with_images);
}

// On one slope all tiles look as on flat ground, however high the eye stands above those below it.
TEST(FarField, ASlopeIsNotOutsideOfTheCell) {
    terrain::Terrain slope =
        terrain_of(400, 400, 1, 1, [](uint32_t column, uint32_t row) { return 150 + 0.1 * column - 0.05 * row; });
    TestField test{Ground(slope)};
    test.images.cell.farthest_m = 60;
    FieldOptions options = test.to_horizon();
    options.ladder.fade_share = options.direction_fade_share = 0;
    Field field = test.field(options);
    glm::dvec2 at(200, -200);
    auto outside = [&](double above_m) {
        uint64_t far = 0, all = 0;
        for (const Item& item : list_of(field, head_camera({at, test.ground.height_m(at) + above_m}, 90, -8)).items)
            if (item.half_count > 0 && item.distance_m > 5 && item.distance_m < 55) ++all, far += item.is_outside_cell;
        return std::pair(far, all);
    };
    auto [none, tiles] = outside(1.7);
    EXPECT_EQ(none, 0u);
    EXPECT_GT(tiles, 100u);
    auto [risen, as_many] = outside(4);
    EXPECT_EQ(risen, as_many);
}

}  // namespace
}  // namespace overlook::wang_ldi
