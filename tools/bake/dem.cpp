// Elevation models of every form: which form it is, and what all of them share.

#include "tools/bake/dem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "formats/mapped_file.h"
#include "tools/bake/dem_forms.h"
#include "tools/bake/png_check.h"
#include "tools/bake/tiff_directory.h"

namespace overlook::dem {
namespace {

constexpr uint64_t kMostSamples = uint64_t(1) << 31;
// The Earth's relief spans 20 km; what is fifty times beyond it is no height.
constexpr double kMostHeight_m = 1e6;

Result<void> check_options(const Options& options) {
    const auto is_positive = [](const std::optional<double>& value) { return !value || (std::isfinite(*value) && *value > 0); };
    if (!is_positive(options.cell_size_m))
        return bad_command("--cell-size-m is {}; a cell's size is above 0", *options.cell_size_m);
    if (options.height_scale_m && (!std::isfinite(*options.height_scale_m) || *options.height_scale_m == 0))
        return bad_command("--height-scale-m is {}; a scale is finite and not 0", *options.height_scale_m);
    return {};
}

Result<Stored> read_form(const InputFile& file, const Options& options) {
    if (file.bytes.empty()) return bad_input("{}: is empty", file.path);
    if (is_tiff(file.bytes)) return read_geotiff(file, options);
    if (is_png(file.bytes)) return read_png(file, options);
    if (is_hgt(file.path)) return read_hgt(file, options);
    return bad_input("{}: is no elevation model that is read: GeoTIFF (.tif), SRTM (.hgt), grey PNG (.png)", file.path);
}

// Samples equal to the "no data" value become NaN. It is compared as the file stores it: as a float among floats, or exactly.
void mark_voids(std::vector<float>& samples, bool are_integers, double nodata) {
    if (std::isnan(nodata)) return;
    if (are_integers && double(float(nodata)) != nodata) return;  // no 8- or 16-bit integer is equal to it
    const float stored = float(nodata);
    std::replace(samples.begin(), samples.end(), stored, std::numeric_limits<float>::quiet_NaN());
}

// No height is absurd. Infinities are: a value that means "no data" has to be said.
Result<void> check_heights(const Raster& raster, const std::string& name) {
    const auto is_absurd = [&](float sample) {
        return !std::isnan(sample) &&
               !(std::abs(raster.height_offset_m + raster.height_scale_m * double(sample)) <= kMostHeight_m);
    };
    const auto at = std::find_if(raster.samples.begin(), raster.samples.end(), is_absurd);
    if (at == raster.samples.end()) return {};
    const size_t index = size_t(at - raster.samples.begin());
    return bad_input("{}: column {}, row {} stores {}, which is no height; if it means \"no data\", give --nodata {}", name,
                     index % raster.width, index / raster.width, *at, *at);
}

std::string bare_name(const std::string& path) {
    return path.substr(path.find_last_of('/') + 1);
}

Result<Raster> finished(Stored stored, const InputFile& file, const Options& options) {
    Raster raster;
    raster.width = stored.width;
    raster.height = stored.height;
    raster.samples = std::move(stored.samples);
    raster.samples_are_integers = stored.samples_are_integers;
    raster.height_scale_m = options.height_scale_m.value_or(stored.height_scale_m);
    raster.height_offset_m = stored.height_offset_m;
    raster.frame = std::move(stored.frame);
    raster.source_name = bare_name(file.path);
    raster.source_hash = content_hash(file.bytes);

    const std::optional<double> nodata = options.nodata ? options.nodata : stored.nodata;
    if (nodata) mark_voids(raster.samples, raster.samples_are_integers, *nodata);
    raster.void_count =
        uint64_t(std::count_if(raster.samples.begin(), raster.samples.end(), [](float s) { return std::isnan(s); }));
    if (raster.void_count == raster.samples.size())
        return bad_input("{}: all of its {} x {} samples are void", file.path, raster.width, raster.height);
    if (auto checked = check_heights(raster, file.path); !checked) return tl::unexpected(checked.error());
    return raster;
}

}  // namespace

Result<Window> window_of(const Options& options, uint32_t width, uint32_t height, const std::string& name) {
    const Window window = options.window.value_or(Window{0, 0, width, height});
    if (window.x > width || window.width > width - window.x || window.y > height || window.height > height - window.y)
        return bad_input("{}: the window {},{} {}x{} reaches beyond the raster, which has {} x {} samples", name, window.x,
                         window.y, window.width, window.height, width, height);
    if (window.width < 2 || window.height < 2)
        return bad_input("{}: {} x {} samples are too few; an elevation model has 2 x 2 at least", name, window.width,
                         window.height);
    if (uint64_t(window.width) * window.height > kMostSamples)
        return impossible("{}: {} x {} samples are more than the {} that fit; bake it in parts with --window", name, window.width,
                          window.height, kMostSamples);
    return window;
}

terrain::Frame plain_frame(double cell_size_m) {
    terrain::Frame frame;
    frame.metres_per_column = cell_size_m;
    frame.metres_per_row = cell_size_m;
    return frame;
}

Result<Raster> open(const std::string& path, const Options& options) {
    if (auto checked = check_options(options); !checked) return tl::unexpected(checked.error());
    Result<MappedFile> mapped = MappedFile::open(path);
    if (!mapped) return tl::unexpected(mapped.error());
    const InputFile file{path, mapped->bytes()};
    try {
        Result<Stored> stored = read_form(file, options);
        if (!stored) return tl::unexpected(stored.error());
        return finished(std::move(*stored), file, options);
    } catch (const std::bad_alloc&) {
        return impossible("{}: does not fit into memory; bake it in parts with --window", path);
    }
}

}  // namespace overlook::dem
