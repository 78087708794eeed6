// A tile among neighbours: what stands there is all of it once, nothing twice, and nothing in another's way.
#include "tools/bake/wang_ldi/stage.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "formats/srgb.h"
#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/assemble.h"
#include "tools/bake/wang_ldi/plant.h"
#include "tools/bake/wang_ldi/shade.h"
#include "tools/bake/wang_ldi/tile_sets.h"

namespace overlook::wang_ldi {
namespace {

struct Ground {
    TileSet set;
    Planting planting;
};
// Of the default set, or one in variants: with objects of corners, of edges and of interiors.
Ground meadow(uint32_t tiles, uint32_t variants) {
    SetOptions set_options;
    set_options.tiles = tiles, set_options.variants = variants;
    if (tiles == 1) set_options.horizontal_colours = set_options.vertical_colours = 1;
    SearchReport search;
    auto set = make_tile_set(set_options, search);
    PlantOptions options;
    options.tile_size_m = 5.36, options.candidates = 2;
    for (auto [tight, packing] : {std::pair{0.45f, 0.5f}, std::pair{0.2f, 0.25f}}) {
        PlantModel model;
        model.name = "flower", model.tight_radius_m = tight, model.packing_radius_m = packing;
        options.models.push_back(model);
    }
    PlantReport report;
    auto planting = plant(*set, options, report);
    EXPECT_TRUE(planting) << planting.error().message;
    return {std::move(*set), std::move(*planting)};
}

TEST(CopiesAmongNeighbours, OfARealPlantingAreAllThereOnceAndOverlapNowhere) {
    for (uint32_t tiles : {1u, 12u, 16u}) {
        Ground ground = meadow(tiles, tiles == 1 ? 3 : 1);
        std::array<size_t, 4> of_owner{};
        for (size_t tile = 0; tile < ground.set.tiles.size(); ++tile) {
            auto around = neighbourhood(ground.set, tile, 17 * tile);
            std::vector<rays::Copy> copies = copies_of(ground.set, ground.planting, around);
            size_t objects = 0;
            for (int place : around) objects += ground.planting.tiles[size_t(place)].size();
            EXPECT_EQ(copies.size(), objects) << tiles << ": " << tile;
            for (const Planted& object : ground.planting.tiles[tile]) ++of_owner[size_t(object.owner)];
            // The first are the middle's own and what hangs over its edges; neighbours at corners may not fit each other.
            size_t own = ground.planting.tiles[tile].size() + overhang(ground.set, ground.planting, tile).size();
            for (size_t a = 0; a < own; ++a)
                for (size_t b = a + 1; b < copies.size(); ++b) {
                    auto tight = [&](const rays::Copy& copy) {
                        return double(ground.planting.models[copy.mesh].tight_radius_m) * double(glm::length(copy.place[2]));
                    };
                    double apart = double(glm::distance(copies[a].place[3], copies[b].place[3]));
                    ASSERT_GE(apart, tight(copies[a]) + tight(copies[b]) - 1e-5) << tiles << ": " << tile << " " << a << " " << b;
                }
        }
        for (size_t owner = 0; owner < 4; ++owner) EXPECT_GT(of_owner[owner], 0u);
    }
}

// Two plants of one model less than a millimetre from each other, on both sides of an edge that owns neither.
TEST(CopiesAmongNeighbours, AreNotTakenForEachOtherWhereTheyAreNear) {
    Planting planting;
    planting.tile_size_m = 4, planting.models = {{"pin", 1e-4f, 1e-4f}};
    Planted west, east;
    west.x_m = 0.0002f, west.y_m = 2, east.x_m = 3.9998f, east.y_m = 2;
    planting.tiles = {{west, east}};
    EXPECT_EQ(copies_of(plants::one_tile(), planting, {0, 0, 0, 0, 0, 0, 0, 0, 0}).size(), 18u);
}

TEST(Neighbours, UnlikeOthersDifferWhereverAnotherFits) {
    Ground ground = meadow(1, 3);
    size_t same = 0;
    for (uint64_t seed = 0; seed < 30; ++seed) {
        std::vector<std::array<int, 9>> own{neighbourhood(ground.set, 0, seed)};
        auto foreign = neighbourhood(ground.set, 0, 1000 + seed, own);
        for (size_t place = 0; place < 9; ++place) same += place != 4 && foreign[place] == own[0][place];
        own.push_back(foreign);
        auto third = neighbourhood(ground.set, 0, 2000 + seed, own);
        for (size_t place = 0; place < 9; ++place)
            same += place != 4 && (third[place] == own[0][place] || third[place] == own[1][place]);
        // None is left: one that fits stands there all the same.
        own.push_back(third);
        for (int tile : neighbourhood(ground.set, 0, 3000 + seed, own)) EXPECT_TRUE(tile >= 0 && tile < 3);
    }
    EXPECT_EQ(same, 0u);
    // Edges fit all the same.
    ground = meadow(12, 1);
    for (uint64_t seed = 0; seed < 20; ++seed) {
        std::vector<std::array<int, 9>> own{neighbourhood(ground.set, 3, seed)};
        auto foreign = neighbourhood(ground.set, 3, 1000 + seed, own);
        auto tile = [&](int place) { return ground.set.tiles[size_t(foreign[size_t(place)])]; };
        EXPECT_EQ(tile(3).east, tile(4).west);
        EXPECT_EQ(tile(4).east, tile(5).west);
        EXPECT_EQ(tile(1).north, tile(4).south);
        EXPECT_EQ(tile(4).north, tile(7).south);
    }
}

// Flattened and as instances, by instructions that are the same everywhere: the same cubes are met, but for rays that pass an
// edge of one, and their colours are the same within two codes.
TEST(Layouts, BothGiveTheSameColours) {
    Models models = plants::models();
    std::vector<rays::Copy> copies = copies_of(plants::one_tile(), plants::planting(3), {0, 0, 0, 0, 0, 0, 0, 0, 0});
    ImageSet set = plants::image_set();
    Light light;
    std::array<std::vector<TraceStage>, 2> stages;
    std::array<Sampled, 2> all;
    std::array<std::vector<glm::vec3>, 2> colours;
    for (size_t way = 0; way < 2; ++way) {
        auto stage = stage_of(models, copies, way == 0 ? uint64_t(1) << 32 : 0, rays::Instructions::everywhere);
        ASSERT_TRUE(stage) << stage.error().message;
        stages[way].push_back(std::move(*stage));
        all[way] = sampled(models, stages[way], wedge_of(set, 1, 1), {});
        colours[way] = lit_samples(models, stages[way], all[way].samples, glm::vec3(0), light, 7);
    }
    std::map<std::pair<uint32_t, uint32_t>, glm::vec3> of_first;
    for (size_t s = 0; s < all[0].samples.size(); ++s)
        of_first[{all[0].samples[s].pixel, all[0].samples[s].layer}] = colours[0][s];
    size_t met_by_both = 0, off = 0;
    for (size_t s = 0; s < all[1].samples.size(); ++s) {
        auto found = of_first.find({all[1].samples[s].pixel, all[1].samples[s].layer});
        if (found == of_first.end()) continue;
        ++met_by_both;
        int most = 0;
        for (int c = 0; c < 3; ++c)
            most = std::max(most, std::abs(int(srgb_from_linear(found->second[c])) - int(srgb_from_linear(colours[1][s][c]))));
        off += most > 2;
    }
    ASSERT_GT(met_by_both, 3000u);
    EXPECT_GE(double(met_by_both), 0.998 * double(std::max(all[0].samples.size(), all[1].samples.size())));
    EXPECT_EQ(off, 0u) << "of " << met_by_both;
}

}  // namespace
}  // namespace overlook::wang_ldi
