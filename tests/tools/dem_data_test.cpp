// The real elevation models of the shared test data: counts and sizes known of each.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/tools/dem_test_files.h"

namespace overlook::test {
namespace {

struct Known {
    const char* file;
    uint32_t width, height;
    uint64_t voids;
    float lowest, highest;
    double metres_per_column, metres_per_row;
    double centre_latitude_deg, centre_longitude_deg;
    const char* crs;
};

// Cell sizes: of degrees by the ellipsoid's closed forms at the middle (georeference_test proves the code against them); of UTM
// the step over the point scale; of web mercator the step times its two scales.
void expect_known(const Known& known) {
    const std::string path = data_file(std::string("dem/") + known.file);
    OVERLOOK_NEED_DATA(path);
    const Result<dem::Raster> raster = dem::open(path, {});
    ASSERT_TRUE(raster) << raster.error().message;
    EXPECT_EQ(raster->width, known.width);
    EXPECT_EQ(raster->height, known.height);
    EXPECT_EQ(raster->void_count, known.voids);
    float lowest = 1e9f, highest = -1e9f;
    for (const float sample : raster->samples)
        if (!std::isnan(sample)) lowest = std::min(lowest, sample), highest = std::max(highest, sample);
    EXPECT_NEAR(lowest, known.lowest, 0.5);
    EXPECT_NEAR(highest, known.highest, 0.5);
    EXPECT_NEAR(raster->frame.metres_per_column, known.metres_per_column, 0.005 * known.metres_per_column);
    EXPECT_NEAR(raster->frame.metres_per_row, known.metres_per_row, 0.005 * known.metres_per_row);
    EXPECT_NEAR(raster->frame.centre_latitude_deg, known.centre_latitude_deg, 0.01);
    EXPECT_NEAR(raster->frame.centre_longitude_deg, known.centre_longitude_deg, 0.01);
    EXPECT_EQ(raster->frame.crs, known.crs);
    EXPECT_LT(raster->frame.scale_distortion, 0.01);
    EXPECT_EQ(raster->height_scale_m, 1);
}

TEST(RealElevationModel, EverestHasItsVoids) {
    expect_known({"everest_srtm3_voids.tif", 1201, 1201, 130953, 192, 8642, 82.3, 92.34, 27.5, 86.5, "EPSG:4326"});
}
TEST(RealElevationModel, BigTujungaIsOnUtm) {
    expect_known({"bigtujunga_utm11.tif", 1197, 643, 0, 315, 2295, 30.0, 30.0, 34.32, -118.15, "EPSG:32611"});
}
TEST(RealElevationModel, GreenRiverIsFloats) {
    expect_known({"greenriver_lidar_1m.tif", 2000, 1000, 0, 1297, 1347, 1.0, 1.0, 38.887, -110.285, "EPSG:6341"});
}
TEST(RealElevationModel, NewHampshireIsAnSrtmTile) {
    expect_known({"N44W072.hgt", 1201, 1201, 0, 115, 1908, 66.2, 92.6, 44.5, -71.5, "EPSG:4326"});
}
TEST(RealElevationModel, WebMercatorRasterShrinksToTrueMetres) {
    expect_known({"small_nodata_3857.tif", 100, 80, 970, 26.6f, 44.1f, 3.0985, 3.0885, 37.75, -122.5, "EPSG:3857"});
}

TEST(RealElevationModel, WindowIsPartOfTheWhole) {
    for (const char* file :
         {"dem/everest_srtm3_voids.tif", "dem/greenriver_lidar_1m.tif", "dem/small_nodata_3857.tif", "dem/N44W072.hgt"}) {
        const std::string path = data_file(file);
        OVERLOOK_NEED_DATA(path);
        const Result<dem::Raster> whole = dem::open(path, {});
        ASSERT_TRUE(whole) << whole.error().message;
        dem::Options options;
        options.window = dem::Window{whole->width / 3, whole->height / 3, whole->width / 2, whole->height / 2};
        const Result<dem::Raster> part = dem::open(path, options);
        ASSERT_TRUE(part) << part.error().message;
        size_t different = 0;
        for (uint32_t y = 0; y < part->height; ++y)
            for (uint32_t x = 0; x < part->width; ++x) {
                const float a = part->samples[size_t(y) * part->width + x];
                const float b = whole->samples[size_t(y + options.window->y) * whole->width + x + options.window->x];
                different += !(a == b || (std::isnan(a) && std::isnan(b)));
            }
        EXPECT_EQ(different, 0u) << file;
        EXPECT_EQ(part->source_hash, whole->source_hash);
    }
}

}  // namespace
}  // namespace overlook::test
