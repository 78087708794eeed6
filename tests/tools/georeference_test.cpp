// Cell sizes against closed forms of the ellipsoid.

#include "tools/bake/georeference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace overlook::test {
namespace {

using dem::Crs;
using dem::GridPlacement;

constexpr double kRadius_m = 6378137, kFlattening = 1 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}
double across_m(double latitude_deg) {  // of one degree of longitude
    const double sine = std::sin(radians(latitude_deg));
    return radians(1) * kRadius_m * std::cos(radians(latitude_deg)) / std::sqrt(1 - kEccentricity2 * sine * sine);
}
double along_m(double latitude_deg) {  // of one degree of latitude
    const double sine = std::sin(radians(latitude_deg));
    return radians(1) * kRadius_m * (1 - kEccentricity2) / std::pow(1 - kEccentricity2 * sine * sine, 1.5);
}

terrain::Frame frame(uint32_t epsg, const GridPlacement& grid, uint32_t width, uint32_t height) {
    const Result<terrain::Frame> result = dem::frame_of(*dem::crs_from_epsg(epsg), grid, width, height, "a.tif");
    EXPECT_TRUE(result) << (result ? "" : result.error().message);
    return result.value_or(terrain::Frame{});
}

TEST(Frame, OfDegreesHasTheEllipsoidsCellSizes) {
    for (const double latitude_deg : {-60.0, 0.5, 27.5, 44.5, 80.0}) {
        const terrain::Frame f = frame(4326, {10, latitude_deg + 0.5, 0.01, 0, 0, -0.01}, 101, 101);
        EXPECT_NEAR(f.metres_per_column, 0.01 * across_m(latitude_deg), 1e-6);
        EXPECT_NEAR(f.metres_per_row, 0.01 * along_m(latitude_deg), 1e-6);
        EXPECT_NEAR(f.centre_latitude_deg, latitude_deg, 1e-9);
        EXPECT_NEAR(f.centre_longitude_deg, 10.5, 1e-9);
        EXPECT_EQ(f.convergence_deg, 0);
        EXPECT_EQ(f.crs, "EPSG:4326");
        EXPECT_TRUE(f.is_georeferenced);
    }
}

TEST(Frame, OfDegreesStatesItsGreatestDistortion) {
    const double worst = std::max(std::abs(across_m(40) / across_m(45) - 1), std::abs(across_m(50) / across_m(45) - 1));
    EXPECT_NEAR(frame(4326, {0, 50, 1, 0, 0, -1}, 11, 11).scale_distortion, worst, 1e-12);
    // The equator, the widest place, lies inside and on no sample.
    const double latitude_deg = 30.3;
    EXPECT_NEAR(frame(4326, {0, latitude_deg + 31, 1, 0, 0, -1}, 11, 63).scale_distortion,
                std::max(across_m(0) / across_m(latitude_deg) - 1, 1 - across_m(latitude_deg + 31) / across_m(latitude_deg)),
                1e-12);
}

TEST(Frame, OfUtmIsTrueToScaleAndTurn) {
    // On the central meridian the scale is 0.9996 and north is up.
    const terrain::Frame middle = frame(32611, {500000 - 1500, 4e6, 30, 0, 0, -30}, 101, 101);
    EXPECT_NEAR(middle.metres_per_column, 30 / 0.9996, 1e-9);
    EXPECT_NEAR(middle.metres_per_row, 30 / 0.9996, 1e-9);
    EXPECT_NEAR(middle.convergence_deg, 0, 1e-9);
    EXPECT_NEAR(middle.centre_longitude_deg, -117, 1e-9);
    // 150 km east of it: k = k0 (1 + x^2 / (2 k0^2 M N)) (Snyder 1987, 8-11, to the second order), convergence = sin(lat) * dlon.
    const terrain::Frame east = frame(32611, {650000 - 1500, 4e6, 30, 0, 0, -30}, 101, 101);
    const double radii = along_m(36.1) / radians(1) * across_m(36.1) / radians(1) / std::cos(radians(36.1));
    const double scale = 0.9996 * (1 + 150e3 * 150e3 / (2 * 0.9996 * 0.9996 * radii));
    EXPECT_NEAR(east.metres_per_column, 30 / scale, 30e-7);
    EXPECT_NEAR(east.convergence_deg, std::sin(radians(east.centre_latitude_deg)) * (east.centre_longitude_deg + 117), 1e-3);
    EXPECT_GT(east.convergence_deg, 0.9);
    // The southern hemisphere mirrors the northern.
    const terrain::Frame south = frame(32711, {650000 - 1500, 1e7 - 4e6 + 3000, 30, 0, 0, -30}, 101, 101);
    EXPECT_NEAR(south.centre_latitude_deg, -east.centre_latitude_deg, 1e-9);
    EXPECT_NEAR(south.metres_per_column, east.metres_per_column, 1e-9);
    EXPECT_NEAR(south.convergence_deg, -east.convergence_deg, 1e-9);
}

TEST(Frame, OfUtmStatesItsGreatestDistortion) {
    // 301 columns of 1 km, the central meridian at a third: least like the middle is the right rim.
    const GridPlacement grid{400000.5, 4e6, 1000, 0, 0, -1000};
    const terrain::Frame f = frame(32611, grid, 301, 3);
    const terrain::Frame right = frame(32611, {700000.5, 4e6, 1, 0, 0, -1}, 2, 2);
    EXPECT_NEAR(f.scale_distortion, 1 - 1000 * right.metres_per_column / f.metres_per_column, 1e-6);
}

TEST(Frame, OfATurnedRasterAddsItsTurn) {
    const double c = 30 * std::cos(radians(20)), s = 30 * std::sin(radians(20));
    const terrain::Frame f = frame(32611, {500000, 4e6, c, -s, -s, -c}, 3, 3);  // columns 20 degrees south of east
    EXPECT_NEAR(f.convergence_deg, 20, 0.01);
    EXPECT_NEAR(f.metres_per_row, 30 / 0.9996, 1e-4);
}

TEST(Frame, OfWebMercatorUndoesItsStretch) {
    const double latitude_deg = 37.74;
    const double y = kRadius_m * std::asinh(std::tan(radians(latitude_deg)));
    const terrain::Frame f = frame(3857, {-13636677 - 40, y + 40, 4, 0, 0, -4}, 21, 21);
    EXPECT_NEAR(f.centre_latitude_deg, latitude_deg, 1e-9);
    EXPECT_NEAR(f.metres_per_column, 4 * across_m(latitude_deg) / (radians(1) * kRadius_m), 1e-9);
    EXPECT_NEAR(f.metres_per_row, 4 * along_m(latitude_deg) * std::cos(radians(latitude_deg)) / (radians(1) * kRadius_m), 1e-9);
}

TEST(Crs, KnowsZonesByTheirCodes) {
    const auto zone = [](uint32_t code) {
        const auto crs = dem::crs_from_epsg(code);
        return crs && crs->kind == dem::CrsKind::utm ? (crs->is_south ? -crs->zone : crs->zone) : 0;
    };
    EXPECT_EQ(zone(32601), 1);
    EXPECT_EQ(zone(32660), 60);
    EXPECT_EQ(zone(32719), -19);
    EXPECT_EQ(zone(26911), 11);
    EXPECT_EQ(zone(25832), 32);
    EXPECT_EQ(zone(6328), 59);
    EXPECT_EQ(zone(6330), 1);
    EXPECT_EQ(zone(6341), 12);
    EXPECT_EQ(zone(6348), 19);
    EXPECT_EQ(zone(3717), 10);
    EXPECT_EQ(zone(28355), -55);
    for (const uint32_t code : {0u, 32600u, 32661u, 6327u, 6349u, 2154u, 32767u}) EXPECT_FALSE(dem::crs_from_epsg(code)) << code;
    EXPECT_NEAR(dem::crs_from_epsg(26711)->equatorial_radius_m, 6378206.4, 1e-9);
}

TEST(Grid, OfAreasStandsHalfACellInside) {
    dem::GeoTiffTags tags;
    tags.pixel_scale = {30, 20, 0};
    tags.tie_points = {2, 1, 0, 1000, 2000, 0};
    const auto grid = [&](std::vector<dem::GeoKey> keys) {
        tags.keys = std::move(keys);
        return *dem::placement_from_tags(tags, "a.tif");
    };
    const GridPlacement area = grid({{1025, 1}}), point = grid({{1025, 2}}), unsaid = grid({});
    EXPECT_EQ(point.origin_x, 940);
    EXPECT_EQ(point.origin_y, 2020);
    EXPECT_EQ(area.origin_x, 955);
    EXPECT_EQ(area.origin_y, 2010);
    EXPECT_EQ(unsaid.origin_x, area.origin_x);
    EXPECT_EQ(area.column_x, 30);
    EXPECT_EQ(area.row_y, -20);
}

}  // namespace
}  // namespace overlook::test
