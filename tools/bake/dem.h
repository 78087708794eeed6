// Elevation models as the bakers see them, whatever file they came from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/terrain.h"

namespace overlook::dem {

// Part of a raster: columns x .. x+width-1, rows y .. y+height-1, in the order that the file stores (a GeoTIFF that is stored
// south first or westward is mirrored after its window is cut out).
struct Window {
    uint32_t x = 0, y = 0, width = 0, height = 0;
};

struct Options {
    std::optional<Window> window;          // default: all of it
    std::optional<double> cell_size_m;     // needed where the file has no reference (PNG); overrides one that it has
    std::optional<double> height_scale_m;  // metres per unit of the stored heights; default: the file's own, or 1
    std::optional<double> nodata;          // a stored value that means "no data"; default: the file's own
};

// A raster of heights. height_m(column, row) = height_offset_m + height_scale_m * samples[row * width + column].
// samples hold what the file stores, exactly (8- and 16-bit integers and 32-bit floats all fit a float); NaN = void.
struct Raster {
    uint32_t width = 0;   // columns, >= 2
    uint32_t height = 0;  // rows, >= 2
    std::vector<float> samples;
    double height_scale_m = 1;
    double height_offset_m = 0;
    bool samples_are_integers = false;
    uint64_t void_count = 0;
    terrain::Frame frame;     // where it lies and how large its cells are, in metres
    std::string source_name;  // bare file name
    std::string source_hash;  // XXH3-128 of the file's bytes, 32 hex digits
};

// Reads an elevation model: GeoTIFF (int8, uint8, int16, uint16, float32; what OpenImageIO decodes; degrees, UTM or web
// mercator), SRTM .hgt, 8- and 16-bit grey PNG, known by their first bytes (.hgt by its name). The file may be hostile. Voids are
// the "no data" value and NaN; an infinity or a height beyond 1000 km that is not declared as "no data" is refused, never drawn.
// Options that make no sense: Exit::bad_command; more than 2^31 samples: Exit::impossible. Otherwise fails with Exit::bad_input
// and one line that names the file and the place: "a.tif: column 1, row 1 stores -3.4e+38, which is no height; if it means "no
// data", give --nodata -3.4e+38". Cost: the file's bytes (for their hash) and the samples of the tiles or strips that the window
// touches.
Result<Raster> open(const std::string& path, const Options& options);

}  // namespace overlook::dem
