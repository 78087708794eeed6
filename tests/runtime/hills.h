// Baked terrains and cameras all round them, for tests of what decides.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <span>

#include "formats/terrain.h"
#include "runtime/view/camera.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::terrain {

inline Terrain baked(const dem::Raster& dem) {
    auto terrain = bake(dem, {}, [](double) {});
    EXPECT_TRUE(terrain.has_value());
    return std::move(*terrain);
}

// Cameras of every kind: above, between and below the hills, far away, looking anywhere, wide and tall.
inline view::Camera random_camera(const Terrain& terrain, uint64_t seed) {
    auto share = [&](uint64_t i) { return test::random_share(77, seed, i); };
    view::Camera camera;
    double east_m = terrain.shape.width * terrain.frame.metres_per_column,
           south_m = terrain.shape.height * terrain.frame.metres_per_row;
    double reach = seed % 5 == 0 ? 3 : 1;
    camera.position_m = {east_m * (0.5 + reach * (share(0) - 0.5)), -south_m * (0.5 + reach * (share(1) - 0.5)),
                         500 + 3000 * share(2) * share(3)};
    camera.heading_deg = 360 * share(4);
    camera.pitch_deg = 100 * share(5) - 80;
    camera.fov_y_deg = 20 + 90 * share(6);
    camera.width_px = seed % 3 == 0 ? 1600 : 400, camera.height_px = seed % 3 == 1 ? 1200 : 500;
    return camera;
}

// 0.5 to 8.
inline double random_tolerance_px(uint64_t seed) {
    return 0.5 * std::pow(16.0, test::random_share(78, seed));
}

// Vertices of a cut that lie in the middle of one of its edges: each is a crack. samples: three a triangle, of rows of `width`.
inline size_t count_t_junctions(std::span<const uint32_t> samples, uint32_t width) {
    std::set<uint32_t> used(samples.begin(), samples.end());
    size_t junctions = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
        uint32_t a = samples[i], b = samples[i % 3 == 2 ? i - 2 : i + 1];
        uint32_t x2 = a % width + b % width, y2 = a / width + b / width;
        if (x2 % 2 == 0 && y2 % 2 == 0) junctions += used.count(y2 / 2 * width + x2 / 2);
    }
    return junctions;
}

}  // namespace overlook::terrain
