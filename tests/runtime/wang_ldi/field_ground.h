// Terrains without a bake, for tests of what is planted on them.
#pragma once

#include <cmath>
#include <functional>

#include "formats/terrain.h"

namespace overlook::wang_ldi {

// height_at(column, row) in metres, rounded to centimetres; not a number: void.
inline terrain::Terrain terrain_of(uint32_t width, uint32_t height, double column_m, double row_m,
                                   const std::function<double(uint32_t, uint32_t)>& height_at) {
    terrain::Terrain terrain;
    terrain.shape = terrain::shape_of(width, height);
    terrain.frame.metres_per_column = column_m, terrain.frame.metres_per_row = row_m;
    terrain.height_step_m = 0.01, terrain.height_offset_m = 100;
    for (uint32_t row = 0; row < height; ++row)
        for (uint32_t column = 0; column < width; ++column) {
            double height_m = height_at(column, row);
            terrain.heights.push_back(std::isnan(height_m) ? terrain::kVoid : int32_t(std::lround((height_m - 100) * 100)));
        }
    return terrain;
}

// Hills of two sizes and a hollow, 60 m high and 1 in 3 steep at most over 10 m cells.
inline double hill_m(double column, double row) {
    return 130 + 40 * std::sin(column * 0.05) * std::cos(row * 0.04) + 4 * std::sin(column * 0.31 + 1) * std::sin(row * 0.27);
}

inline const terrain::Terrain& hills() {
    static const terrain::Terrain terrain = terrain_of(121, 90, 10, 12, hill_m);
    return terrain;
}

}  // namespace overlook::wang_ldi
