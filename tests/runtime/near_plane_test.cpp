#include "runtime/terrain/near_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::terrain {
namespace {

Terrain hills() {
    auto terrain = bake(test::make_hills(65, 65, 3, 0.02), {}, [](double) {});
    EXPECT_TRUE(terrain.has_value());
    return std::move(*terrain);
}

// The surface's height by the finest triangles, at a place within the raster: a cell's diagonal goes through the corner whose
// coordinates are both odd or both even, whichever lies on it.
double ground_m(const Terrain& terrain, double x_m, double y_m) {
    double column = x_m / terrain.frame.metres_per_column, row = -y_m / terrain.frame.metres_per_row;
    uint32_t x = uint32_t(column), y = uint32_t(row);
    double u = column - x, v = row - y;
    auto z = [&](uint32_t i, uint32_t j) {
        return terrain.height_offset_m + terrain.height_step_m * terrain.heights[size_t(y + j) * terrain.shape.width + x + i];
    };
    if (((x ^ y) & 1) == 0)  // from the north-west to the south-east
        return u > v ? z(0, 0) + u * (z(1, 0) - z(0, 0)) + v * (z(1, 1) - z(1, 0))
                     : z(0, 0) + v * (z(0, 1) - z(0, 0)) + u * (z(1, 1) - z(0, 1));
    return u + v < 1 ? z(0, 0) + u * (z(1, 0) - z(0, 0)) + v * (z(0, 1) - z(0, 0))
                     : z(1, 1) + (1 - u) * (z(0, 1) - z(1, 1)) + (1 - v) * (z(1, 0) - z(1, 1));
}

TEST(NearPlane, KnowsTheDistanceToFlatGround) {
    Terrain flat = hills();
    std::fill(flat.heights.begin(), flat.heights.end(), 7);
    double top_m = flat.height_offset_m + 7 * flat.height_step_m;
    double side_m = 64 * flat.frame.metres_per_column;
    EXPECT_NEAR(distance_to_ground_m(flat, {side_m / 3, -side_m / 3, top_m + 2.5}, 100), 2.5, 1e-9);
    EXPECT_NEAR(distance_to_ground_m(flat, {side_m / 3, -side_m / 3, top_m - 2.5}, 100), 2.5, 1e-9);
    EXPECT_NEAR(distance_to_ground_m(flat, {-3, -side_m / 3, top_m + 4}, 100), 5, 1e-9);  // beside the raster
    EXPECT_EQ(distance_to_ground_m(flat, {side_m / 3, -side_m / 3, top_m + 250}, 100), 100);
}

TEST(NearPlane, SeesNoGroundInAVoid) {
    Terrain terrain = hills();
    std::fill(terrain.heights.begin(), terrain.heights.end(), kVoid);
    EXPECT_EQ(distance_to_ground_m(terrain, {10, -10, 0}, 50), 50);
}

// Points of the surface round the eye that are in the frame are never before the near plane, and a camera high above keeps its
// own.
TEST(NearPlane, CutsNothingOffTheGround) {
    Terrain terrain = hills();
    double cell_m = terrain.frame.metres_per_column;
    int in_frame = 0, would_be_cut = 0;
    for (uint64_t seed = 0; seed < 60; ++seed) {
        view::Camera camera;
        camera.width_px = 640, camera.height_px = 480, camera.near_m = 0.2 * cell_m;
        double x_m = cell_m * (8 + 48 * test::random_share(5, seed, 0)),
               y_m = -cell_m * (8 + 48 * test::random_share(5, seed, 1));
        double clearance_m = 0.4 * cell_m * test::random_share(5, seed, 2);
        camera.position_m = {x_m, y_m, ground_m(terrain, x_m, y_m) + clearance_m};
        camera.heading_deg = 360 * test::random_share(5, seed, 3);
        camera.pitch_deg = 60 * test::random_share(5, seed, 4) - 40;
        view::Camera clear = with_clear_near_plane(terrain, camera);
        EXPECT_LE(clear.near_m, camera.near_m);
        EXPECT_GT(clear.near_m, 0);
        view::Axes axes = view::axes_of(camera);
        double focal_px = view::focal_px(camera);
        for (int i = -30; i <= 30; ++i)
            for (int j = -30; j <= 30; ++j) {
                double at_x_m = x_m + 0.02 * cell_m * i, at_y_m = y_m + 0.02 * cell_m * j;
                glm::dvec3 away = glm::dvec3{at_x_m, at_y_m, ground_m(terrain, at_x_m, at_y_m)} - camera.position_m;
                double depth_m = glm::dot(away, axes.forward);
                bool is_in_frame = depth_m > 0 && std::abs(glm::dot(away, axes.right)) * focal_px <= 320 * depth_m &&
                                   std::abs(glm::dot(away, axes.up)) * focal_px <= 240 * depth_m;
                if (!is_in_frame) continue;
                ++in_frame;
                would_be_cut += depth_m < camera.near_m;
                EXPECT_GE(depth_m, clear.near_m) << seed;
            }
    }
    EXPECT_GT(in_frame, 1000);
    EXPECT_GT(would_be_cut, 0);

    view::Camera high;
    high.position_m = {cell_m * 32, -cell_m * 32, terrain.height_offset_m + 1e5};
    EXPECT_EQ(with_clear_near_plane(terrain, high).near_m, high.near_m);
}

}  // namespace
}  // namespace overlook::terrain
