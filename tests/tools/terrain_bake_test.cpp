#include "tools/bake/terrain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/terrain_check.h"
#include "runtime/terrain/refine.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/baked/prove_terrain.h"

namespace overlook::terrain {
namespace {

Terrain baked(const dem::Raster& dem, const BakeOptions& options = {}) {
    auto terrain = bake(dem, options, [](double) {});
    EXPECT_TRUE(terrain.has_value());
    return std::move(*terrain);
}

constexpr double kTolerances_m[] = {500, 50, 20, 5, 1, 0.5};

TEST(TerrainBake, KeepsWholeNumbersExactly) {
    dem::Raster dem = test::make_hills(50, 40, 1);
    dem.height_scale_m = 0.3048, dem.height_offset_m = -100;
    Terrain terrain = baked(dem);
    EXPECT_EQ(terrain.finest_error_m, 0);
    for (uint32_t row = 0; row < 40; ++row)
        for (uint32_t column = 0; column < 50; ++column)
            EXPECT_DOUBLE_EQ(terrain.height_m(column, row), -100 + 0.3048 * double(dem.samples[row * 50 + column]));
}

TEST(TerrainBake, CountsTheRoundingOfHeightsTowardsEveryError) {
    dem::Raster dem = test::make_dem(
        33, 33, [](uint32_t x, uint32_t y) { return float(test::random_share(3, x, y) * 40); }, false);
    Terrain terrain = baked(dem, {0.5});
    EXPECT_GT(terrain.finest_error_m, 0.2);
    EXPECT_LE(terrain.finest_error_m, 0.25);
    EXPECT_EQ(terrain.error_m[0], float_at_least(terrain.finest_error_m));
    EXPECT_TRUE(prove(terrain, source_of(dem), kTolerances_m, [](double) {}).holds());
}

TEST(TerrainBake, KeepsItsPromisesOnAnyRasterSize) {
    for (auto [width, height] :
         {std::pair{2u, 2u}, {2u, 30u}, {3u, 3u}, {64u, 65u}, {65u, 65u}, {66u, 67u}, {130u, 31u}, {257u, 200u}}) {
        dem::Raster dem = test::make_hills(width, height, width + height);
        Proof proof = prove(baked(dem), source_of(dem), kTolerances_m, [](double) {});
        EXPECT_TRUE(proof.holds()) << width << " x " << height;
        for (const CutProof& cut : proof.cuts) EXPECT_EQ(cut.report.uncovered_valid_samples, 0u);
    }
}

TEST(TerrainBake, KeepsItsPromisesRoundVoids) {
    for (double share : {0.02, 0.3, 0.9}) {
        dem::Raster dem = test::make_hills(150, 99, 4, share);
        ASSERT_GT(dem.void_count, 0u);
        Terrain terrain = baked(dem);
        EXPECT_FALSE(find_unmarked_void(terrain).has_value());
        Proof proof = prove(terrain, source_of(dem), kTolerances_m, [](double) {});
        EXPECT_TRUE(proof.holds()) << share;
        EXPECT_GT(proof.cuts[0].void_rim_triangle_count, 0u);
    }
}

TEST(TerrainBake, NestsItsCodes) {
    EXPECT_FALSE(find_code_above_parent(baked(test::make_hills(201, 77, 8, 0.1))).has_value());
}

TEST(TerrainBake, SaysWhichStepTheHeightsNeed) {
    dem::Raster dem = test::make_dem(
        4, 4, [](uint32_t, uint32_t) { return 9000.5f; }, false);
    auto terrain = bake(dem, {1e-6}, [](double) {});
    ASSERT_FALSE(terrain.has_value());
    EXPECT_EQ(terrain.error().exit, Exit::impossible);
    EXPECT_EQ(terrain.error().message, "heights up to 9000.5 m do not fit steps of 1e-06 m; at least 3.4e-05 m is needed");
}

// The prover itself must be able to fail.
TEST(TerrainProof, FindsAnErrorTableThatPromisesTooMuch) {
    dem::Raster dem = test::make_hills(65, 65, 2);
    Terrain terrain = baked(dem);
    for (size_t code = 1; code < kMustSplit; ++code) terrain.error_m[code] /= 2;
    Proof proof = prove(terrain, source_of(dem), kTolerances_m, [](double) {});
    EXPECT_FALSE(proof.holds());
    EXPECT_GT(proof.triangles.count(), 100u);
    ASSERT_FALSE(proof.triangles.worst().empty());
    EXPECT_GT(proof.triangles.worst()[0].measured_m, proof.triangles.worst()[0].promised_m);
}

TEST(TerrainProof, FindsAHeightThatIsNotTheSources) {
    dem::Raster dem = test::make_hills(65, 65, 2);
    Terrain terrain = baked(dem);
    terrain.heights[65 * 30 + 17] += 3;
    Proof proof = prove(terrain, source_of(dem), {}, [](double) {});
    ASSERT_EQ(proof.heights.count(), 1u);
    EXPECT_EQ(proof.heights.worst()[0].column, 17u);
    EXPECT_EQ(proof.heights.worst()[0].row, 30u);
}

TEST(TerrainProof, FindsAVoidThatBecameGround) {
    dem::Raster dem = test::make_hills(65, 65, 2, 0.1);
    Terrain terrain = baked(dem);
    for (int32_t& height : terrain.heights)
        if (height == kVoid) height = 0;
    EXPECT_EQ(prove(terrain, source_of(dem), {}, [](double) {}).heights.count(), dem.void_count);
}

TEST(CutCheck, FindsAMissingATwofoldAndABentTriangle) {
    dem::Raster dem = test::make_hills(33, 33, 6);
    Terrain terrain = baked(dem);
    Source source = source_of(dem);
    Refiner refiner(terrain);
    Cut cut;
    refiner.cut_by_metres(20, cut);
    EXPECT_TRUE(check_cut(terrain, source, cut.indices, 20).is_sound());

    std::vector<uint32_t> missing(cut.indices.begin() + 3 * 40, cut.indices.end());
    CutReport report = check_cut(terrain, source, missing, 20);
    EXPECT_GT(report.wrongly_covered_cells, 0u);
    EXPECT_GT(report.open_interior_edges, 0u);

    std::vector<uint32_t> twofold = cut.indices;
    twofold.insert(twofold.end(), cut.indices.begin() + 60, cut.indices.begin() + 63);
    report = check_cut(terrain, source, twofold, 20);
    EXPECT_GT(report.wrongly_covered_cells, 0u);
    EXPECT_GT(report.overused_edges, 0u);

    EXPECT_GT(check_cut(terrain, source, cut.indices, 1).places.count(), 0u);
}

}  // namespace
}  // namespace overlook::terrain
