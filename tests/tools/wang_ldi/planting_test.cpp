// Plantings overlap in no legal neighbourhood, leave no place, and are as dense across edges and corners as within; the paper's
// are not.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tools/bake/wang_ldi/evenness.h"
#include "tools/bake/wang_ldi/plant.h"
#include "tools/bake/wang_ldi/planting_check.h"
#include "tools/bake/wang_ldi/point_spectrum.h"
#include "tools/bake/wang_ldi/tile_sets.h"

namespace overlook::wang_ldi {
namespace {

TileSet set_of(SetOptions options) {
    SearchReport report;
    auto set = make_tile_set(options, report);
    EXPECT_TRUE(set) << set.error().message;
    return set ? *set : TileSet{};
}
const TileSet& set_of(uint32_t tiles) {
    static std::map<uint32_t, TileSet> made;  // a search each
    if (!made.contains(tiles)) {
        SetOptions options;
        options.tiles = tiles;
        if (tiles == 1) options.horizontal_colours = options.vertical_colours = 1;
        made[tiles] = set_of(options);
    }
    return made[tiles];
}
PlantModel model_of(float tight_m, float packing_m) {
    PlantModel model;
    model.name = "flower.obj", model.tight_radius_m = tight_m, model.packing_radius_m = packing_m;
    return model;
}
// About 20 objects a tile, as the paper's sunflowers.
PlantOptions sunflowers() {
    PlantOptions options;
    options.tile_size_m = 5.36, options.models = {model_of(0.45f, 0.5f)};
    return options;
}
PlantOptions mixed() {
    PlantOptions options;
    options.tile_size_m = 6, options.models = {model_of(0.3f, 0.45f), model_of(0.2f, 0.3f), model_of(0.1f, 0.15f)};
    options.models[0].least_scale = 0.8, options.models[0].most_scale = 1.25;
    options.models[0].weight = 2, options.models[2].weight = 3;
    options.candidates = 2;
    return options;
}
Planting planted(const TileSet& set, const PlantOptions& options, PlantReport* report = nullptr) {
    PlantReport own;
    auto planting = plant(set, options, report ? *report : own);
    EXPECT_TRUE(planting) << planting.error().message;
    return planting ? std::move(*planting) : Planting{};
}

TEST(Planting, OverlapsInNoLegalNeighbourhood) {
    for (uint32_t tiles : {1u, 8u, 12u, 16u})
        for (const PlantOptions& options : {sunflowers(), mixed()}) {
            TileSet set = set_of(tiles);
            OverlapReport overlaps = check_overlaps(set, planted(set, options));
            EXPECT_EQ(overlaps.tight_overlaps, 0u);
            EXPECT_EQ(overlaps.packing_overlaps, 0u);
            EXPECT_GE(overlaps.neighbourhoods, tiles * (tiles == 1 ? 5u : 4u));
        }
}

TEST(Planting, LeavesNoPlaceForOneMoreInAnyTiling) {
    for (const PlantOptions& options : {sunflowers(), mixed()}) {
        TileSet set = set_of(12);
        Planting planting = planted(set, options);
        double least_m = options.models.size() == 1 ? 0.5 : 0.15;
        EXPECT_EQ(tiles_with_a_place(set, planting, least_m), 0u);
        auto tiling = tile_row_by_row(set, 24, 24, {});
        ASSERT_TRUE(tiling);
        EXPECT_EQ(more_per_tile(planting, *tiling, least_m, 1), 0);
        // The check sees what is missing.
        planting.tiles[3].erase(std::find_if(planting.tiles[3].begin(), planting.tiles[3].end(),
                                             [](const Planted& object) { return object.owner == Owner::interior; }));
        EXPECT_EQ(tiles_with_a_place(set, planting, least_m), 1u);
    }
}

TEST(Planting, IsAsDenseAcrossEdgesAndCornersAsWithinAndWellSpread) {
    for (uint32_t tiles : {8u, 12u, 16u})
        for (uint64_t seed : {1u, 2u}) {
            PlantOptions options = sunflowers();
            options.seed = seed;
            TileSet set = set_of(tiles);
            Planting planting = planted(set, options);
            ZoneDensity zones = zone_density(planting, edge_reach_m(options));
            for (double density : {zones.corner, zones.edge, zones.inside}) {
                EXPECT_GE(density, 0.95) << tiles << " " << seed;
                EXPECT_LE(density, 1.05) << tiles << " " << seed;
            }
            EXPECT_GE(relative_radius(planting, check_overlaps(set, planting)), 0.7) << tiles << " " << seed;
        }
}

TEST(Planting, HasTheRadialPowerOfAPoissonDiskSet) {
    TileSet set = set_of(16);
    auto tiling = tile_row_by_row(set, 32, 32, {});
    ASSERT_TRUE(tiling);
    PlantOptions options = sunflowers();
    Points points = points_of(planted(set, options), *tiling);
    Points disks = poisson_disk_points(points.size_m, 0.5, 1);
    EXPECT_NEAR(double(points.places_m.size()) / double(disks.places_m.size()), 1, 0.05);
    PointSpectrum ours = spectrum_of(points, 3, 16), plain = spectrum_of(disks, 3, 16);
    double difference = 0;
    for (size_t ring = 0; ring < 16; ++ring) difference += std::abs(ours.radial_power[ring] - plain.radial_power[ring]) / 16;
    EXPECT_LE(difference, 0.12);
    EXPECT_LE(ours.radial_power[1], 0.2);  // hardly anything below the distance of neighbours
    // Sixteen plots that come again and again show as a grid of peaks, which a plain set has not.
    EXPECT_GE(ours.greatest_peak, 10 * plain.greatest_peak);
    for (double anisotropy_db : plain.anisotropy_db) EXPECT_LE(std::abs(anisotropy_db), 4);
}

TEST(Planting, IsTheSameForTheSameSeedAndAnotherForAnother) {
    TileSet set = set_of(12);
    PlantOptions options = mixed();
    EXPECT_TRUE(planted(set, options) == planted(set, options));
    PlantOptions other = options;
    other.seed = 2;
    EXPECT_FALSE(planted(set, options) == planted(set, other));
}

TEST(Planting, KeepsModelsToTheirWeights) {
    TileSet set = set_of(16);
    PlantOptions options = sunflowers();
    options.models = {model_of(0.4f, 0.5f), model_of(0.3f, 0.5f), model_of(0.2f, 0.5f)};
    options.models[1].weight = 2, options.models[2].weight = 5;
    std::vector<double> count(3, 0);
    double all = 0;
    for (const auto& tile : planted(set, options).tiles)
        for (const Planted& object : tile) ++count[object.model], ++all;
    for (size_t m = 0; m < 3; ++m) EXPECT_NEAR(count[m] / all, options.models[m].weight / 8, 0.03) << m;
}

TEST(Planting, KeepsScalesAndTurnsInTheirRanges) {
    PlantOptions options = mixed();
    options.models[0].least_turn_rad = 1, options.models[0].most_turn_rad = 2;
    float least = 9, most = 0;
    for (const auto& tile : planted(set_of(12), options).tiles)
        for (const Planted& object : tile) {
            if (object.model != 0) continue;
            EXPECT_GE(object.turn_rad, 1);
            EXPECT_LE(object.turn_rad, 2);
            least = std::min(least, object.scale), most = std::max(most, object.scale);
        }
    EXPECT_GE(least, 0.8f);
    EXPECT_LE(most, 1.25f);
    EXPECT_GE(most - least, 0.3f);
}

TEST(Planting, OfADensityHasIt) {
    TileSet set = set_of(12);
    PlantOptions options = sunflowers();
    options.density_per_m2 = 0.4, options.candidates = 8;
    PlantReport report;
    Planting planting = planted(set, options, &report);
    size_t objects = 0;
    for (const auto& tile : planting.tiles) objects += tile.size();
    EXPECT_NEAR(double(objects) / (12 * 5.36 * 5.36), 0.4, 0.01);
    EXPECT_EQ(check_overlaps(set, planting).packing_overlaps, 0u);

    options.density_per_m2 = 2;
    auto none = plant(set, options, report);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().exit, Exit::bad_input);
    EXPECT_NE(none.error().message.find(fmt::format("{:.4g} do", report.full_density_per_m2)), std::string::npos)
        << none.error().message;
}

TEST(Planting, OfATileThatIsTooSmallIsRefused) {
    PlantOptions options = sunflowers();
    options.tile_size_m = 3;
    PlantReport report;
    for (auto planting : {plant(set_of(12), options, report), plant_as_paper(set_of(12), options, report)}) {
        ASSERT_FALSE(planting);
        EXPECT_EQ(planting.error().exit, Exit::bad_input);
        EXPECT_NE(planting.error().message.find("tile_size_m"), std::string::npos);
    }
}

TEST(Planting, ThinsOutTowardsThinnerCorners) {
    SetOptions set_options;
    set_options.kind = SetKind::corners, set_options.corner_density = {1, 0.5f, 0};
    TileSet set = set_of(set_options);
    PlantOptions options = sunflowers();
    options.candidates = 8;
    Planting planting = planted(set, options);
    EXPECT_EQ(check_overlaps(set, planting).packing_overlaps, 0u);
    std::vector<double> objects(9, 0), tiles(9, 0);
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        double quarters = 0;
        for (uint8_t corner : corners_of(set, set.tiles[t])) quarters += 2 * double(set.corner_density[corner]);
        objects[size_t(quarters)] += double(planting.tiles[t].size()), ++tiles[size_t(quarters)];
    }
    for (size_t eighth = 0; eighth < 9; ++eighth)
        EXPECT_NEAR(objects[eighth] / tiles[eighth] / (objects[8] / tiles[8]), double(eighth) / 8, 0.08) << eighth;
}

TEST(Planting, EndsAtBareCornersWithNothingBeyond) {
    SetOptions set_options;
    set_options.has_borders = true;
    TileSet set = set_of(set_options);
    PlantOptions options = sunflowers();
    options.candidates = 4;
    Planting planting = planted(set, options);
    EXPECT_EQ(check_overlaps(set, planting).packing_overlaps, 0u);
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        std::array<uint8_t, 4> corners = corners_of(set, set.tiles[t]);
        if (corners == std::array<uint8_t, 4>{1, 1, 1, 1}) {
            EXPECT_TRUE(planting.tiles[t].empty());
        }
        if (corners == std::array<uint8_t, 4>{0, 0, 0, 0}) {
            EXPECT_GE(planting.tiles[t].size(), 15u);
        }
        std::vector<Planted> around = overhang(set, planting, t);
        for (const Planted& object : around)
            EXPECT_TRUE(object.x_m < 0 || object.y_m < 0 || object.x_m >= 5.36f || object.y_m >= 5.36f);
    }
}

TEST(Planting, PutsTreesIntoSomeVariantsOnly) {
    SetOptions set_options;
    set_options.variants = 2;
    TileSet set = set_of(set_options);
    PlantOptions options = sunflowers();
    options.candidates = 2;
    options.models.push_back(model_of(1.5f, 1.6f));
    options.models[1].per_tile = 1, options.models[1].variants = {1};
    Planting planting = planted(set, options);
    EXPECT_EQ(check_overlaps(set, planting).packing_overlaps, 0u);
    EXPECT_EQ(tiles_with_a_place(set, planting, 0.5), 0u);
    for (size_t t = 0; t < set.tiles.size(); ++t) {
        size_t trees = 0;
        for (const Planted& object : planting.tiles[t]) {
            trees += object.model == 1;
            if (object.model == 1) {
                EXPECT_EQ(object.owner, Owner::interior);
            }
        }
        EXPECT_EQ(trees, t % 2);
    }
    options.models[1].per_tile = 9;
    PlantReport report;
    auto none = plant(set, options, report);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().exit, Exit::bad_input);
    EXPECT_NE(none.error().message.find("did"), std::string::npos);
}

TEST(PaperPlanting, OverlapsNowhereButLeavesVoidsAtCorners) {
    for (uint32_t tiles : {8u, 16u}) {
        TileSet set = set_of(tiles);
        PlantOptions options = sunflowers();
        PlantReport report;
        auto planting = plant_as_paper(set, options, report);
        ASSERT_TRUE(planting) << planting.error().message;
        OverlapReport overlaps = check_overlaps(set, *planting);
        EXPECT_EQ(overlaps.tight_overlaps, 0u);
        EXPECT_GE(report.rounds, 10u);
        // Nothing within a tight radius of a corner, and much less about it.
        EXPECT_EQ(density_by_corner_distance(*planting, 0.45, 1)[0], 0);
        EXPECT_LE(zone_density(*planting, 0.5).corner, 0.95);
        auto tiling = tile_row_by_row(set, 24, 24, {});
        ASSERT_TRUE(tiling) << tiling.error().message;
        EXPECT_GE(more_per_tile(*planting, *tiling, 0.5, 1), 1);
    }
}

TEST(PaperPlanting, OfWhatThePaperDoesNotKnowIsRefused) {
    SetOptions borders;
    borders.has_borders = true;
    PlantOptions options = sunflowers();
    PlantReport report;
    auto bare = plant_as_paper(set_of(borders), options, report);
    ASSERT_FALSE(bare);
    EXPECT_EQ(bare.error().exit, Exit::bad_input);
    EXPECT_NE(bare.error().message.find("no borders"), std::string::npos) << bare.error().message;
    options.models.push_back(model_of(1, 1.2f));
    options.models[1].per_tile = 1;
    auto tree = plant_as_paper(set_of(12), options, report);
    ASSERT_FALSE(tree);
    EXPECT_EQ(tree.error().exit, Exit::bad_input);
    EXPECT_NE(tree.error().message.find("per_tile"), std::string::npos) << tree.error().message;
}

TEST(Planting, PutsTreesBesidesTheFlowersThatAreAskedFor) {
    PlantOptions options = sunflowers();
    options.tile_size_m = 12, options.candidates = 4, options.density_per_m2 = 0.4;
    options.models.push_back(model_of(0.9f, 1));
    options.models[1].per_tile = 5;
    PlantReport report;
    Planting planting = planted(set_of(12), options, &report);
    double flowers = 0;
    for (const auto& tile : planting.tiles)
        for (const Planted& object : tile) flowers += object.model == 0;
    EXPECT_NEAR(flowers / 12 / 144, 0.4, 0.01);
    EXPECT_NEAR(report.density_per_m2, 0.4, 0.01);
}

TEST(PaperPlanting, HasAlmostAsManyObjectsInEveryTile) {
    TileSet set = set_of(12);
    PlantOptions options = sunflowers();
    options.density_per_m2 = 0.5;
    PlantReport report;
    auto planting = plant_as_paper(set, options, report);
    ASSERT_TRUE(planting);
    EXPECT_NEAR(report.density_per_m2, 0.5, 0.03);
    // Counts spread half as far as those of darts that are thrown without turns, at most.
    double mean = report.density_per_m2 * options.tile_size_m * options.tile_size_m, squares = 0;
    for (const auto& tile : planting->tiles) squares += (double(tile.size()) - mean) * (double(tile.size()) - mean);
    EXPECT_LE(std::sqrt(squares / double(planting->tiles.size())), std::sqrt(mean) / 2);
}

TEST(PaperPlanting, PlantsEveryModelAsOftenAsItsWeightSays) {
    TileSet set = set_of(12);
    PlantOptions options = mixed();
    options.density_per_m2 = 0.6;
    PlantReport report;
    auto planting = plant_as_paper(set, options, report);
    ASSERT_TRUE(planting);
    std::array<double, 3> shares{};
    double all = 0;
    for (const auto& tile : planting->tiles)
        for (const Planted& object : tile) shares[object.model] += 1, all += 1;
    EXPECT_NEAR(shares[0] / all, 2.0 / 6, 0.08);
    EXPECT_NEAR(shares[1] / all, 1.0 / 6, 0.08);
    EXPECT_NEAR(shares[2] / all, 3.0 / 6, 0.08);
    EXPECT_EQ(check_overlaps(set, *planting).tight_overlaps, 0u);
}

TEST(RelativeRadius, IsOneOfAHexagonalGridAndFallsAsItThins) {
    // Rows of discs that touch, repeated: a tile of 7 x 8 rows of them is nearly square.
    TileSet set;
    set.tiles = {{}};
    Planting planting{7, {Model{"disc", 0.5f, 0.5f}}, {{}}};
    for (int row = 0; row < 8; ++row)
        for (int column = 0; column < 7; ++column) {
            Planted object;
            object.x_m = float(column + (row % 2) * 0.5), object.y_m = float(row * 7.0 / 8);
            planting.tiles[0].push_back(object);
        }
    OverlapReport overlaps = check_overlaps(set, planting);
    double expected =
        std::sqrt(56 * std::numbers::pi / 4 / 49 / (std::numbers::pi / (2 * std::numbers::sqrt3))) * overlaps.least_packing_ratio;
    EXPECT_NEAR(relative_radius(planting, overlaps), expected, 1e-6);
    EXPECT_NEAR(relative_radius(planting, overlaps), 1, 0.02);
    planting.tiles[0].resize(14);
    EXPECT_NEAR(relative_radius(planting, overlaps), expected / 2, 1e-6);
}

}  // namespace
}  // namespace overlook::wang_ldi
