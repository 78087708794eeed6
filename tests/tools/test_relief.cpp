#include "tools/bake/relief.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "formats/parallel.h"
#include "tools/bake/relief_colour.h"
#include "tools/bake/relief_light.h"

namespace overlook {
namespace {

using relief::Field;

// Heights from columns and rows, cells of 10 m.
dem::Raster raster_of(uint32_t width, uint32_t height, const std::function<double(uint32_t, uint32_t)>& height_m) {
    dem::Raster dem;
    dem.width = width;
    dem.height = height;
    dem.frame.metres_per_column = dem.frame.metres_per_row = 10;
    for (uint32_t row = 0; row < height; ++row)
        for (uint32_t column = 0; column < width; ++column) dem.samples.push_back(float(height_m(column, row)));
    return dem;
}

Field field_of(const dem::Raster& dem) {
    return {dem.width, dem.height, dem.frame.metres_per_column, dem.frame.metres_per_row, dem.samples};
}

using Pixel = std::array<int, 3>;
Pixel pixel(const ImageRgb8& image, uint32_t column, uint32_t row) {
    size_t i = (size_t(row) * image.width + column) * 3;
    return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

dem::Raster hills() {
    return raster_of(150, 90, [](uint32_t x, uint32_t y) { return 300 * std::sin(x * 0.11) * std::cos(y * 0.07) + x; });
}

TEST(Relief, ColoursFlatGroundUniformly) {
    for (double height_m : {0.0, -420.0, 8000.0}) {
        ImageRgb8 image = shade_relief(raster_of(60, 40, [=](uint32_t, uint32_t) { return height_m; }), {});
        for (uint32_t row = 0; row < 40; ++row)
            for (uint32_t column = 0; column < 60; ++column) ASSERT_EQ(pixel(image, column, row), pixel(image, 0, 0));
    }
}

TEST(Relief, PaintsVoidsGreyAndOnlyThose) {
    ImageRgb8 image =
        shade_relief(raster_of(60, 40, [](uint32_t x, uint32_t y) { return x > 20 && x < 30 && y > 9 ? NAN : 3.0 * x; }), {});
    for (uint32_t row = 0; row < 40; ++row)
        for (uint32_t column = 0; column < 60; ++column) {
            bool is_void = column > 20 && column < 30 && row > 9;
            ASSERT_EQ(pixel(image, column, row) == (Pixel{128, 128, 128}), is_void) << column << "," << row;
        }
}

TEST(Relief, OfNothingButVoidsIsGrey) {
    for (uint8_t value : shade_relief(raster_of(8, 8, [](uint32_t, uint32_t) { return NAN; }), {}).pixels) ASSERT_EQ(value, 128);
}

TEST(Relief, IsTheSameWithAnyThreadCount) {
    set_thread_count(1);
    ImageRgb8 one = shade_relief(hills(), {});
    for (unsigned threads : {2u, 7u}) {
        set_thread_count(threads);
        EXPECT_EQ(one.pixels, shade_relief(hills(), {}).pixels) << threads << " threads";
    }
    set_thread_count(0);
}

TEST(Relief, IsReducedToFitWithoutLosingVoids) {
    ReliefOptions options;
    options.max_side_px = 50;
    ImageRgb8 image = shade_relief(raster_of(151, 90, [](uint32_t x, uint32_t) { return x < 4 ? NAN : 5.0 * x; }), options);
    EXPECT_EQ(image.width, 38u);
    EXPECT_EQ(image.height, 23u);
    EXPECT_EQ(pixel(image, 0, 5), (Pixel{128, 128, 128}));
    EXPECT_NE(pixel(image, 1, 5), (Pixel{128, 128, 128}));
}

TEST(Relief, MakesSlopesTowardsTheSunBrighter) {
    auto plane = [](double tangent) {
        return raster_of(60, 60, [=](uint32_t x, uint32_t) { return tangent * 10 * (x - 30.0); });
    };
    ReliefOptions options;
    options.sun_azimuth_deg = 270;
    Pixel towards = pixel(shade_relief(plane(0.4), options), 30, 30), away = pixel(shade_relief(plane(-0.4), options), 30, 30);
    for (size_t c = 0; c < 3; ++c) EXPECT_GT(towards[c], away[c] + 20);
}

TEST(Relief, ShowsNearlyFlatGround) {
    ImageRgb8 image = shade_relief(raster_of(200, 40, [](uint32_t x, uint32_t) { return 2 * std::sin(x * 0.1); }), {});
    int darkest = 255, brightest = 0;
    for (uint32_t column = 20; column < 180; ++column) {
        darkest = std::min(darkest, pixel(image, column, 20)[1]);
        brightest = std::max(brightest, pixel(image, column, 20)[1]);
    }
    EXPECT_GT(brightest, darkest + 25);
}

// The plane z = x tan(90 - altitude) falls towards a sun in the west; its normal is the sun's direction.
TEST(ReliefLight, FallsFullOnAPlaneThatFacesTheSun) {
    double altitude_deg = 38, tangent = 1 / std::tan(altitude_deg * 3.14159265358979323846 / 180);
    Field field = field_of(raster_of(30, 20, [=](uint32_t x, uint32_t) { return tangent * 10 * x; }));
    relief::Slopes slopes = relief::slopes_of(field);
    relief::Vector sun = relief::sun_direction(270, altitude_deg);
    for (size_t i = 0; i < field.height_m.size(); ++i) {
        double length = std::sqrt(1 + slopes.right[i] * slopes.right[i] + slopes.up[i] * slopes.up[i]);
        EXPECT_NEAR((sun[2] - slopes.right[i] * sun[0] - slopes.up[i] * sun[1]) / length, 1, 1e-6);
    }
}

TEST(ReliefLight, PutsTheSunWhereTheCompassSays) {
    relief::Vector east = relief::sun_direction(90, 0), north = relief::sun_direction(0, 0), top = relief::sun_direction(12, 90);
    EXPECT_NEAR(east[0], 1, 1e-12);
    EXPECT_NEAR(north[1], 1, 1e-12);
    EXPECT_NEAR(top[2], 1, 1e-12);
}

TEST(ReliefLight, TakesNorthAsUpTheRaster) {
    relief::Slopes slopes = relief::slopes_of(field_of(raster_of(5, 5, [](uint32_t, uint32_t y) { return -20.0 * y; })));
    EXPECT_NEAR(slopes.up[12], 2, 1e-6);
    EXPECT_EQ(slopes.right[12], 0);
}

// A wall of 100 m under a sun at 45 degrees shades 100 m of level ground: ten cells, the tenth at its soft
// edge.
TEST(ReliefLight, WallCastsAShadowAsLongAsGeometrySays) {
    for (double azimuth_deg : {0.0, 90.0, 180.0, 270.0}) {
        Field field = field_of(raster_of(
            61, 61, [=](uint32_t x, uint32_t y) { return (std::fmod(azimuth_deg, 180) == 0 ? y : x) == 30 ? 100.0 : 0.0; }));
        std::vector<float> visible = relief::sun_visibility(field, azimuth_deg, 45);
        int dx = azimuth_deg == 90 ? -1 : azimuth_deg == 270 ? 1 : 0, dy = azimuth_deg == 0 ? 1 : azimuth_deg == 180 ? -1 : 0;
        for (int n = 1; n <= 30; ++n) {
            float share = visible[size_t(30 + n * dy) * 61 + size_t(30 + n * dx)];
            EXPECT_NEAR(share, n < 10 ? 0 : n == 10 ? 0.5 : 1, 1e-5) << azimuth_deg << " degrees, " << n << " cells behind";
            EXPECT_EQ(visible[size_t(30 - n * dy) * 61 + size_t(30 - n * dx)], 1) << n << " cells before";
        }
    }
}

// Across the grid's diagonal the same wall, much longer than its shadow, shades 100 m measured along the
// sun's azimuth.
TEST(ReliefLight, ShadowIsAsLongAcrossTheDiagonal) {
    Field field = field_of(raster_of(121, 121, [](uint32_t x, uint32_t y) { return x + y <= 120 ? 100.0 : 0.0; }));
    std::vector<float> visible = relief::sun_visibility(field, 315, 45);
    double length_m = 0;
    for (uint32_t n = 61; n < 121; ++n) length_m += (1 - visible[size_t(n) * 121 + n]) * 10 * std::sqrt(2.0);
    EXPECT_NEAR(length_m, 100, 15);
}

TEST(ReliefLight, LevelGroundSeesAllTheSkyAndAPitLess) {
    Field field = field_of(raster_of(101, 101, [](uint32_t x, uint32_t y) { return x == 50 && y == 50 ? -10.0 : 0.0; }));
    std::vector<float> sky = relief::sky_visibility(field, 1);
    EXPECT_EQ(sky[20 * 101 + 20], 1);
    // The brim stands 10 m up at 10 m, or at 14.1 m over the corners: cos^2 is 1/2 or 2/3.
    EXPECT_GT(sky[50 * 101 + 50], 0.5f - 1e-6f);
    EXPECT_LT(sky[50 * 101 + 50], 2.0f / 3);
}

TEST(ReliefLight, LocalMeanOfAPlaneIsThePlane) {
    Field field = field_of(raster_of(40, 30, [](uint32_t x, uint32_t y) { return 3.0 * x - 2.0 * y; }));
    std::vector<float> mean = relief::local_mean(field, 4);
    for (uint32_t row = 4; row < 26; ++row)
        for (uint32_t column = 4; column < 36; ++column) ASSERT_NEAR(mean[row * 40 + column], field.at(column, row), 1e-4);
    EXPECT_NEAR(mean[0], 3.0 * 2 - 2.0 * 2, 1e-4);
}

TEST(ReliefColour, EncodesEverySrgbValueBack) {
    for (int value = 0; value < 256; ++value) {
        relief::Colour linear = relief::linear_from_srgb(uint8_t(value), 0, 0);
        EXPECT_EQ(relief::srgb_from_linear(linear[0]), value);
    }
    EXPECT_EQ(relief::srgb_from_linear(-1), 0);
    EXPECT_EQ(relief::srgb_from_linear(2), 255);
}

TEST(ReliefColour, FindsALakeButNoTerraceAndNoPlain) {
    auto lake = [](uint32_t x, uint32_t y) {
        double r = std::hypot(x - 50.0, y - 50.0);
        return r < 20 ? 0.0 : r - 19;
    };
    std::vector<uint8_t> wet = relief::find_water(field_of(raster_of(100, 100, lake)), 300);
    EXPECT_EQ(wet[50 * 100 + 50], 1);
    EXPECT_EQ(wet[10 * 100 + 50], 0);
    auto terraces = [](uint32_t x, uint32_t) { return std::floor(x / 30.0); };
    for (uint8_t is_wet : relief::find_water(field_of(raster_of(120, 100, terraces)), 300)) ASSERT_EQ(is_wet, 0);
    for (uint8_t is_wet : relief::find_water(field_of(raster_of(90, 90, [](uint32_t, uint32_t) { return 4; })), 300))
        ASSERT_EQ(is_wet, 0);
}

}  // namespace
}  // namespace overlook
