// G of the method `terrain`: no triangle is further off on the screen than was promised of it, and the promises are not idle.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"
#include "tools/measure/honesty/terrain_honesty.h"
#include "tools/measure/numbers/honesty_tally.h"

namespace overlook::measure {
namespace {

terrain::Terrain baked(const dem::Raster& dem) {
    auto terrain = terrain::bake(dem, {}, [](double) {});
    EXPECT_TRUE(terrain.has_value());
    return std::move(*terrain);
}

// Wide and tall frames, from skimming the ground to far above it, looking anywhere from level to down.
view::Camera random_camera(const terrain::Terrain& terrain, double lowest_m, double highest_m, uint64_t seed) {
    auto share = [&](uint64_t i) { return test::random_share(91, seed, i); };
    uint32_t column = uint32_t(share(0) * (terrain.shape.width - 1)), row = uint32_t(share(1) * (terrain.shape.height - 1));
    double ground_m = terrain.is_void(column, row) ? highest_m : terrain.height_m(column, row);
    double size_m = terrain.shape.width * terrain.frame.metres_per_column;
    view::Camera camera;
    camera.position_m = {column * terrain.frame.metres_per_column, -(row * terrain.frame.metres_per_row),
                         ground_m + 2 + (highest_m - lowest_m + 0.3 * size_m) * std::pow(share(2), 3)};
    camera.heading_deg = 360 * share(3), camera.pitch_deg = 20 - 80 * share(4) * share(4), camera.fov_y_deg = 25 + 80 * share(5);
    camera.width_px = seed % 3 == 0 ? 1920 : 640, camera.height_px = seed % 3 == 1 ? 1600 : 480;
    return camera;
}

Honesty honesty_from_cameras(const terrain::Terrain& terrain, int cameras, double morph) {
    terrain::Refiner refiner(terrain);
    terrain::Cut cut;
    cut.wants_codes = true;
    HonestyTally tally;
    for (int seed = 0; seed < cameras; ++seed) {
        view::Camera camera = random_camera(terrain, refiner.lowest_m(), refiner.highest_m(), uint64_t(seed));
        double error_px = 1 * std::pow(8.0, test::random_share(92, uint64_t(seed)));
        refiner.cut_by_pixels(camera, error_px, cut, morph);
        Promises promises = promises_of(terrain, cut, camera, error_px);
        tally.add(promises.predicted_px, promises.measured_px);
    }
    return tally.all();
}

void expect_honest(const Honesty& honesty) {
    EXPECT_TRUE(is_honest(honesty));
    EXPECT_EQ(honesty.above_prediction, 0u);
    EXPECT_GT(honesty.count - honesty.exact, 10000u);
    EXPECT_GE(honesty.ratio_median, 0.3);
    ::testing::Test::RecordProperty("greatest_share", std::to_string(honesty.ratio_max));
    ::testing::Test::RecordProperty("median_share", std::to_string(honesty.ratio_median));
}

TEST(TerrainHonesty, IsKeptOnHillsWithVoids) {
    expect_honest(honesty_from_cameras(baked(test::make_hills(257, 200, 31, 0.01)), 150, 0));
}

TEST(TerrainHonesty, IsKeptWhileMorphing) {
    expect_honest(honesty_from_cameras(baked(test::make_hills(257, 200, 31, 0.01)), 150, 0.5));
}

// The same numbers must be able to fail.
TEST(TerrainHonesty, IsBrokenByAnErrorTableThatPromisesTooMuch) {
    terrain::Terrain terrain = baked(test::make_hills(129, 129, 31));
    for (size_t code = 1; code < terrain::kMustSplit; ++code) terrain.error_m[code] *= 0.4f;
    Honesty honesty = honesty_from_cameras(terrain, 20, 0);
    EXPECT_FALSE(is_honest(honesty));
    EXPECT_GT(honesty.above_prediction, 100u);
    EXPECT_GT(honesty.ratio_max, 1.5);
}

TEST(TerrainHonesty, OfAnIdlePromiseIsSeenInTheMedian) {
    terrain::Terrain terrain = baked(test::make_hills(129, 129, 31));
    for (size_t code = 1; code < terrain::kMustSplit; ++code) terrain.error_m[code] *= 5;
    EXPECT_FALSE(is_honest(honesty_from_cameras(terrain, 20, 0)));
}

class TerrainHonestyOf : public testing::TestWithParam<const char*> {};

// Together 1,000 cameras over three real elevation models.
TEST_P(TerrainHonestyOf, IsKeptFromEveryCamera) {
    const char* folder = std::getenv("OVERLOOK_DATA");
    if (folder == nullptr) GTEST_SKIP() << "OVERLOOK_DATA is not set: no real elevation models";
    dem::Options options;
    options.window = dem::Window{100, 60, 513, 513};
    auto dem = dem::open(std::string(folder) + "/dem/" + GetParam(), options);
    ASSERT_TRUE(dem.has_value()) << dem.error().message;
    expect_honest(honesty_from_cameras(baked(*dem), 334, 0));
}

INSTANTIATE_TEST_SUITE_P(Dems, TerrainHonestyOf,
                         testing::Values("N44W072.hgt", "bigtujunga_utm11.tif", "greenriver_lidar_1m.tif"), [](const auto& test) {
                             return std::string(test.param).substr(0, std::string(test.param).find('_')).substr(0, 7);
                         });

}  // namespace
}  // namespace overlook::measure
