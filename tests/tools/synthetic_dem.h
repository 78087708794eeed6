// Elevation models whose heights are known, for tests of baking and refining.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include "tools/bake/dem.h"

namespace overlook::test {

// The same numbers everywhere: a hash of the seed and a position, 0 .. 2^32 - 1 (Wang's mixing steps, with splitmix64's
// constants).
inline uint32_t noise(uint64_t seed, uint64_t x, uint64_t y) {
    uint64_t z = seed * 0x9e3779b97f4a7c15u + x * 0xbf58476d1ce4e5b9u + y * 0x94d049bb133111ebu;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return uint32_t((z ^ (z >> 31)) >> 16);
}

// 0 .. 1.
inline double random_share(uint64_t seed, uint64_t x, uint64_t y = 0) {
    return noise(seed, x, y) / 4294967296.0;
}

inline dem::Raster make_dem(uint32_t width, uint32_t height, const std::function<float(uint32_t, uint32_t)>& height_at,
                            bool integers = true) {
    dem::Raster dem;
    dem.width = width, dem.height = height;
    dem.samples_are_integers = integers;
    dem.frame.metres_per_column = 30, dem.frame.metres_per_row = 40;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            dem.samples.push_back(height_at(x, y));
            dem.void_count += std::isnan(dem.samples.back());
        }
    return dem;
}

// Hills of several sizes with noise on them; `void_share` of the samples in round holes are missing.
inline dem::Raster make_hills(uint32_t width, uint32_t height, uint64_t seed, double void_share = 0) {
    return make_dem(width, height, [=](uint32_t x, uint32_t y) {
        double hills = 300 * std::sin(x * 0.05 + double(seed)) * std::cos(y * 0.04) +
                       80 * std::sin(x * 0.31) * std::sin(y * 0.27 + 1) + 12 * random_share(seed, x, y);
        bool is_void = random_share(seed + 1, x / 6, y / 6) < void_share && random_share(seed + 2, x, y) < 0.7;
        return is_void ? std::numeric_limits<float>::quiet_NaN() : float(std::lround(1000 + hills));
    });
}

}  // namespace overlook::test
