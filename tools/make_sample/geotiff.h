// Heights as the simplest GeoTIFF: little-endian, uncompressed 32-bit floats in strips, on a UTM grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace overlook::sample {

// Where the raster lies: centre of the first (north-western) sample, in metres of a projected reference
// system.
struct Placement {
    uint16_t epsg = 32632;  // WGS 84 / UTM zone 32N
    double easting_m = 500000;
    double northing_m = 5200000;
    double cell_m = 30;
};

// The bytes of the file (TIFF 6.0; OGC GeoTIFF 1.1). samples: [height, width] row-major, north first; width
// and height at least 1. Each sample is a point, not an area. `nodata`, if given, is named in the file (tag
// 42113). Under 4 GiB.
std::vector<std::byte> geotiff_bytes(std::span<const float> samples, uint32_t width, uint32_t height, const Placement& placement,
                                     std::optional<int> nodata);

}  // namespace overlook::sample
