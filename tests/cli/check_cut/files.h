// What check_cut reads, by means of its own: it shares no code with Overlook, so that a mistake there is not a mistake here.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace check_cut {

// Part of a raster; width 0 = all of it.
struct Window {
    int64_t x = 0, y = 0, width = 0, height = 0;
};

struct Raster {
    int64_t width = 0, height = 0;
    std::vector<double> heights_m;  // [height, width] row-major, north first; NaN = void
};

struct Mesh {
    std::vector<std::array<double, 3>> vertices;     // column, row, metres
    std::vector<std::array<uint32_t, 3>> triangles;  // each number is below vertices.size()
};

// A .hgt file (big-endian int16, -32768 = void) or whatever OpenImageIO reads. A stored value that equals `nodata` is a void; NaN
// always is one. Throws std::runtime_error.
Raster read_raster(const std::string& path, const Window& window, double nodata);

// A binary little-endian PLY: vertices with x, y, z as float or double, faces as lists of three numbers. Throws
// std::runtime_error.
Mesh read_ply(const std::string& path);

}  // namespace check_cut
