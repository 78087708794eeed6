// What a GeoTIFF says of its raster beside the samples: their form, their grid, its reference, and which value means "no data".
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/result.h"

namespace overlook::dem {

enum class SampleFormat : uint32_t { unsigned_integer = 1, signed_integer = 2, real = 3 };

// A GeoKey whose value is a whole number (all that decide a reference are).
struct GeoKey {
    uint16_t id = 0;
    uint16_t value = 0;
};

constexpr uint16_t kGtModelType = 1024, kGtRasterType = 1025, kGtCitation = 1026, kGeographicType = 2048, kGeogCitation = 2049,
                   kGeogAngularUnits = 2054, kProjectedType = 3072, kProjectedCitation = 3073, kProjection = 3074,
                   kProjLinearUnits = 3076, kVerticalType = 4096, kVerticalUnits = 4099;

struct GeoTiffTags {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t bits_per_sample = 1;
    SampleFormat sample_format = SampleFormat::unsigned_integer;
    uint32_t samples_per_pixel = 1;
    uint32_t photometric = 1;            // 0: white is zero, 1: black is zero
    std::vector<double> pixel_scale;     // 33550: none or 3
    std::vector<double> tie_points;      // 33922: 6 each (column, row, level, x, y, z)
    std::vector<double> transformation;  // 34264: none or 16, row-major
    std::vector<GeoKey> keys;            // in rising order of id
    std::string citation;                // the reference in the file's own words, printable ASCII, or empty
    uint32_t orientation = 1;            // 274: 1 = first row at the top, first column at the left
    std::string gdal_metadata;           // 42112, XML, or empty
    std::optional<std::string> nodata;   // 42113, as text

    std::optional<uint16_t> key(uint16_t id) const;
};

// Reads the tags of a GeoTIFF's first image. The bytes may be hostile: every offset and count is checked against them, and so is
// every strip and tile that holds samples, so that a file that was cut short anywhere is refused before it is decoded.
// Fails with Exit::bad_input as read_tiff_directory does, and:
//   "NAME: TIFF tile 7 (bytes 1000 to 2000) ends after the file, which is 1500 bytes long; was the copy cut short?"
//   "NAME: TIFF tile 7 is empty (a sparse file); write it whole, with gdal_translate -co SPARSE_OK=FALSE"
Result<GeoTiffTags> read_geotiff_tags(std::span<const std::byte> bytes, const std::string& name);

}  // namespace overlook::dem
