// Sun, shadow and open sky over a grid of heights: the geometry of the shaded relief, each part with a truth
// of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace overlook::relief {

// height_m: [height, width] row-major, north first; NaN = void. Cells are column_m x row_m metres.
struct Field {
    uint32_t width = 0, height = 0;
    double column_m = 1, row_m = 1;
    std::vector<float> height_m;

    float at(uint32_t column, uint32_t row) const { return height_m[size_t(row) * width + column]; }
};

using Vector = std::array<double, 3>;  // east (right), north (up the raster), up

// Unit vector towards a sun at an azimuth (degrees from up the raster, over right) and altitude (degrees
// above level).
Vector sun_direction(double azimuth_deg, double altitude_deg);

// Rise to the right and rise up the raster, tangents, from the neighbours left and right, above and below;
// where one is void or beyond the border, from the cell itself. 0 on voids.
struct Slopes {
    std::vector<float> right, up;  // [n] each
};
Slopes slopes_of(const Field& field);

// Share of the sun that reaches each cell past what stands between, 0..1; 1 on voids, which cast none. One
// sweep along the sun's azimuth, O(n): the height of the shadow is carried from row to row (or column to
// column), falling by the tangent of the altitude. A wall of height h shades h / tan(altitude) behind it; the
// edge of the shadow is one cell soft.
std::vector<float> sun_visibility(const Field& field, double azimuth_deg, double altitude_deg);

// Share of an evenly bright sky that level ground sees past the horizon around it, 0..1: mean of cos^2 of the
// horizon's altitude in 16 directions, each looked up at growing distances as far as 64 cells. Heights are
// exaggerated by `exaggeration` first. 1 on voids. O(n).
std::vector<float> sky_visibility(const Field& field, double exaggeration);

// Mean of the valid cells in windows of (2 radius + 1)^2 cells, cut off at the border. NaN on voids. O(n).
std::vector<float> local_mean(const Field& field, uint32_t radius);

}  // namespace overlook::relief
