// What is checked of a planting is what every pair of its objects says, at a cost that grows with the objects; and what could not
// be planted or written is refused before it is tried.
#include "tools/bake/wang_ldi/planting_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/wang_ground.h"
#include "runtime/wang_ldi/random.h"
#include "tests/formats/scratch_folder.h"
#include "tools/bake/wang_ldi/plant.h"

namespace overlook::wang_ldi {
namespace {

// Two tiles that stand beside themselves, and above each other.
TileSet two_tiles() {
    TileSet set;
    set.vertical.resize(2);
    set.tiles = {{0, 0, 0, 0}, {0, 1, 0, 1}};
    return set;
}
Planting scattered(size_t objects, double size_m, const std::vector<float>& radii_m, double least_scale, uint64_t seed) {
    Planting planting;
    planting.tile_size_m = size_m;
    for (float radius_m : radii_m) planting.models.push_back({"model", radius_m * 0.75f, radius_m});
    planting.tiles.resize(2);
    Random random(seed);
    for (auto& tile : planting.tiles)
        for (size_t i = 0; i < objects; ++i) {
            Planted object;
            object.model = random.next_below(uint32_t(radii_m.size()));
            object.x_m = float(random.next_unit() * size_m * 0.9999), object.y_m = float(random.next_unit() * size_m * 0.9999);
            object.scale = float(least_scale + (1 - least_scale) * random.next_unit());
            tile.push_back(object);
        }
    return planting;
}

// Every pair, one after the other.
struct EveryPair {
    const Planting& planting;
    OverlapReport report{0, 0, 0, HUGE_VAL, HUGE_VAL};

    void look(size_t a, size_t b, int x_tiles, int y_tiles) {
        ++report.neighbourhoods;
        for (size_t i = 0; i < planting.tiles[a].size(); ++i)
            for (size_t j = x_tiles == 0 && y_tiles == 0 ? i + 1 : 0; j < planting.tiles[b].size(); ++j) {
                const Planted &p = planting.tiles[a][i], &q = planting.tiles[b][j];
                double x = double(q.x_m) + x_tiles * planting.tile_size_m - double(p.x_m);
                double y = double(q.y_m) + y_tiles * planting.tile_size_m - double(p.y_m), apart = std::hypot(x, y);
                auto sum = [&](float Model::*radius) {
                    return double(planting.models[p.model].*radius) * double(p.scale) +
                           double(planting.models[q.model].*radius) * double(q.scale);
                };
                double tight = sum(&Model::tight_radius_m), packing = sum(&Model::packing_radius_m);
                report.tight_overlaps += apart < tight - 1e-12, report.packing_overlaps += apart / packing < 1;
                report.least_tight_gap_m = std::min(report.least_tight_gap_m, apart - tight);
                report.least_packing_ratio = std::min(report.least_packing_ratio, apart / packing);
            }
    }
    OverlapReport run() {
        for (size_t a = 0; a < 2; ++a)
            for (size_t b = 0; b < 2; ++b) {
                if (a == b) look(a, b, 0, 0), look(a, b, 1, 0), look(a, b, 1, 1), look(a, b, -1, 1);
                look(a, b, 0, 1);  // one colour of horizontal edges
                if (a != b) look(a, b, 1, 1), look(a, b, -1, 1);
            }
        return report;
    }
};

TEST(OverlapCheck, SaysWhatEveryPairOfObjectsSays) {
    struct Case {
        size_t objects;
        double size_m;
        std::vector<float> radii_m;
        double least_scale;
    };
    const std::vector<Case> cases{{0, 4, {0.1f}, 1},
                                  {1, 4, {0.1f}, 1},
                                  {2, 100, {0.001f}, 1},
                                  {40, 4, {0.3f}, 0.5},
                                  {60, 10, {0.01f}, 1},
                                  {200, 5, {1.5f, 0.02f, 0.1f}, 0.3},
                                  {300, 3, {0.05f, 3.0f}, 0.9},
                                  {80, 50, {0.4f, 1e-4f}, 0.2}};
    for (const Case& one : cases)
        for (uint64_t seed : {1u, 2u, 3u}) {
            Planting planting = scattered(one.objects, one.size_m, one.radii_m, one.least_scale, seed);
            OverlapReport right = EveryPair{planting}.run(), checked = check_overlaps(two_tiles(), planting);
            SCOPED_TRACE(testing::Message() << one.objects << " on " << one.size_m << " m, seed " << seed);
            EXPECT_FALSE(checked.is_cut_short);
            EXPECT_EQ(checked.tight_overlaps, right.tight_overlaps);
            EXPECT_EQ(checked.packing_overlaps, right.packing_overlaps);
            EXPECT_EQ(checked.least_packing_ratio, right.least_packing_ratio);
            if (std::isfinite(right.least_tight_gap_m)) {
                EXPECT_NEAR(checked.least_tight_gap_m, right.least_tight_gap_m, 1e-12);
            }
        }
}

// A grid of `side` x `side` objects with as much room as their packing radii, and a tree among them.
Planting meadow(uint32_t side) {
    Planting planting;
    planting.tile_size_m = side * 0.25;
    planting.models = {{"grass", 0.1f, 0.12f}, {"tree", 0.3f * float(side) * 0.25f, 0.3f * float(side) * 0.25f}};
    planting.tiles.resize(2);
    Random random(9);
    for (auto& tile : planting.tiles)
        for (uint32_t i = 0; i < side * side; ++i) {
            Planted object;
            object.x_m = float(0.25 * (i % side) + 0.124 + 0.01 * random.next_unit());
            object.y_m = float(0.25 * (i / side) + 0.124 + 0.01 * random.next_unit());
            if (i == side * side / 2) object.model = 1;
            bool is_under_tree =
                std::hypot(double(object.x_m) - side * 0.125, double(object.y_m) - side * 0.125) < 0.4 * side * 0.25;
            if (object.model == 0 && is_under_tree) continue;
            tile.push_back(object);
        }
    return planting;
}

TEST(OverlapCheck, LooksAtPairsThatGrowWithTheObjects) {
    double before = 0;
    for (uint32_t side : {20u, 40u, 80u, 160u}) {
        Planting planting = meadow(side);
        auto objects = double(planting.tiles[0].size() + planting.tiles[1].size());
        OverlapReport report = check_overlaps(two_tiles(), planting);
        EXPECT_FALSE(report.is_cut_short);
        double each = double(report.looks) / objects;
        EXPECT_LT(each, 150) << side;
        if (before > 0) {
            EXPECT_LT(each, 1.1 * before) << side;
        }
        before = each;
    }
}

// All in one place, as a file may have them: the check ends and says that it did not come to the end.
TEST(OverlapCheck, OfAHostilePlantingIsCutShortWithAWord) {
    Planting planting = scattered(2000, 1, {0.9f}, 1, 5);
    OverlapReport all = check_overlaps(two_tiles(), planting), cut = check_overlaps(two_tiles(), planting, 100'000);
    EXPECT_FALSE(all.is_cut_short);
    EXPECT_TRUE(cut.is_cut_short);
    EXPECT_LE(cut.looks, 110'000u);
    EXPECT_GT(cut.tight_overlaps, 1000u);
    EXPECT_LT(cut.tight_overlaps, all.tight_overlaps);
}

// What was looked at in part is no proof; two that overlap are one, of the contrary.
TEST(OverlapCheck, CutShortIsUnprovenUnlessItIsBrokenAlready) {
    Planting apart = meadow(20), together = scattered(2000, 1, {0.9f}, 1, 5);
    for (auto& tile : apart.tiles) std::erase_if(tile, [](const Planted& object) { return object.model == 1; });
    EXPECT_EQ(verdict_of(check_overlaps(two_tiles(), apart)), Verdict::hold);
    OverlapReport cut = check_overlaps(two_tiles(), apart, 500);
    EXPECT_TRUE(cut.is_cut_short);
    EXPECT_EQ(verdict_of(cut), Verdict::unproven);
    EXPECT_EQ(verdict_of(check_overlaps(two_tiles(), together, 100'000)), Verdict::broken);
}

PlantOptions options_of(double tile_size_m, float packing_radius_m) {
    PlantOptions options;
    options.tile_size_m = tile_size_m;
    PlantModel model;
    model.name = "moss.obj", model.tight_radius_m = model.packing_radius_m = packing_radius_m;
    options.models = {model};
    return options;
}

TEST(Planting, OfMoreThanCanBeHeldIsRefusedBeforeItBegins) {
    PlantReport report;
    auto expect_refused = [&](const PlantOptions& options, const char* radius) {
        for (auto* way : {plant, plant_as_paper}) {
            auto made = way(two_tiles(), options, report);
            ASSERT_FALSE(made);
            EXPECT_EQ(made.error().exit, Exit::bad_input);
            for (const char* part : {"tile_size_m: ", "is too large", "moss.obj", radius})
                EXPECT_NE(made.error().message.find(part), std::string::npos) << made.error().message;
        }
    };
    expect_refused(options_of(100'000, 1e-5f), "1e-05 m");
    expect_refused(options_of(20'000, 1), "is 1 m");
    PlantOptions scaled = options_of(20, 1);
    scaled.models[0].least_scale = 1e-3, scaled.models[0].most_scale = 1;
    expect_refused(scaled, "0.001 m");
    PlantOptions per_tile = options_of(20, 1);
    per_tile.models.push_back(per_tile.models[0]);
    per_tile.models[1].per_tile = 1, per_tile.models[1].packing_radius_m = per_tile.models[1].tight_radius_m = 1e-6f;
    auto made = plant(two_tiles(), per_tile, report);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("1e-06 m"), std::string::npos) << made.error().message;
    // The size that it names can be planted, as far as this goes.
    std::string text = plant(two_tiles(), options_of(20'000, 1), report).error().message;
    EXPECT_NE(text.find("tiles of 4096 m at most"), std::string::npos) << text;
}

TEST(PlantingSize, IsRefusedByTheWriterWhereTheReaderWould) {
    PlantedTiles ground;
    ground.set.tiles = {Tile{}};
    ground.planting.tile_size_m = 4, ground.planting.models = {{"moss.obj", 0.1f, 0.1f}};
    Planted object;
    object.x_m = object.y_m = 2;
    // 16 + 12 + 8 + 4 bytes, and 24 of each object: 2^28 - 16 hold 11,184,809 of them.
    ground.planting.tiles.assign(1, std::vector<Planted>(11'184'809, object));
    EXPECT_TRUE(check_size(ground.planting));
    ground.planting.tiles[0].push_back(object);
    auto size = check_size(ground.planting);
    ASSERT_FALSE(size);
    EXPECT_EQ(size.error().exit, Exit::impossible);
    for (const char* part : {"11184810 objects", "take 268435480 bytes", "268435456 are possible"})
        EXPECT_NE(size.error().message.find(part), std::string::npos) << size.error().message;
    ScratchFolder folder;
    auto writer = container::Writer::create(folder / "a.ovl", kKind);
    ASSERT_TRUE(writer);
    auto written = write(*writer, ground);
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().message.find("W6"), std::string::npos) << written.error().message;
}

}  // namespace
}  // namespace overlook::wang_ldi
