// The forms of elevation models, each read by a source file of its own (dem_geotiff.cpp, dem_hgt.cpp, dem_png.cpp) and finished
// by dem.cpp, which knows what they share: voids, absurd heights, names.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/bake/dem.h"

namespace overlook::dem {

struct InputFile {
    std::string path;
    std::span<const std::byte> bytes;
};

// What a form's reader hands on: samples as stored (a "no data" value still among them), their scale, their frame.
struct Stored {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> samples;
    bool samples_are_integers = false;
    double height_scale_m = 1;
    double height_offset_m = 0;
    std::optional<double> nodata;  // of the file; Options::nodata comes before it
    terrain::Frame frame;
};

Result<Stored> read_geotiff(const InputFile& file, const Options& options);
Result<Stored> read_hgt(const InputFile& file, const Options& options);
Result<Stored> read_png(const InputFile& file, const Options& options);

bool is_hgt(const std::string& path);

// The window asked for, or all of a raster. Fails with Exit::bad_input:
//   "NAME: the window 0,0 900x900 reaches beyond the raster, which has 100 x 80 samples"
//   "NAME: 1 x 80 samples are too few; an elevation model has 2 x 2 at least"
// and with Exit::impossible if there are more than 2^31 samples.
Result<Window> window_of(const Options& options, uint32_t width, uint32_t height, const std::string& name);

// The frame that --cell-size-m gives: square cells, no reference.
terrain::Frame plain_frame(double cell_size_m);

}  // namespace overlook::dem
