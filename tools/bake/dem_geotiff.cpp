// GeoTIFF as an elevation model: tags by geotiff_tags.cpp, samples by images.cpp, place by georeference.cpp.

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/bake/dem_forms.h"
#include "tools/bake/gdal_metadata.h"
#include "tools/bake/georeference.h"
#include "tools/bake/geotiff_tags.h"
#include "tools/bake/images.h"

namespace overlook::dem {
namespace {

Result<void> check_form(const GeoTiffTags& tags, const std::string& name) {
    if (tags.samples_per_pixel != 1)
        return bad_input("{}: has {} channels, an elevation model has one; is it a picture?", name, tags.samples_per_pixel);
    if (tags.photometric > 1)
        return bad_input("{}: its samples are colours (PhotometricInterpretation {}), not heights", name, tags.photometric);
    if (tags.photometric == 0)
        return bad_input(
            "{}: stores white as zero (PhotometricInterpretation 0), so high and low could be exchanged; write it with "
            "gdal_translate -co PHOTOMETRIC=MINISBLACK",
            name);
    if (tags.orientation != 1)
        return bad_input(
            "{}: its rows do not run from the top left (Orientation {}); write it with gdal_translate, which leaves that out",
            name, tags.orientation);
    const bool is_real = tags.sample_format == SampleFormat::real;
    const bool is_read = is_real ? tags.bits_per_sample == 32 : tags.bits_per_sample == 8 || tags.bits_per_sample == 16;
    if (!is_read)
        return bad_input(
            "{}: its samples are {}-bit {}s; read are 8- and 16-bit integers and 32-bit floats, convert it with "
            "gdal_translate -ot Float32",
            name, tags.bits_per_sample, is_real ? "float" : "integer");
    return {};
}

// GDAL writes the value as text, which may be "nan" or "-inf" and may have blanks around it.
Result<std::optional<double>> nodata_from_tags(const GeoTiffTags& tags, const Options& options, const std::string& name) {
    if (!tags.nodata || options.nodata) return std::optional<double>();
    std::string_view text = *tags.nodata;
    while (!text.empty() && (text.front() == ' ' || text.front() == '+')) text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || problem != std::errc() || end != text.data() + text.size()) {
        std::string shown(text.substr(0, 40));
        std::replace_if(
            shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
        return bad_input("{}: its \"no data\" value (GDAL_NODATA) is \"{}\", which is not a number; give it with --nodata", name,
                         shown);
    }
    return std::optional<double>(value);
}

// The raster's order as Mirroring wants it.
void mirror(std::vector<float>& samples, uint32_t width, uint32_t height, const Mirroring& mirroring) {
    const auto row = [&](uint32_t y) { return samples.begin() + std::ptrdiff_t(size_t(y) * width); };
    if (mirroring.rows)
        for (uint32_t y = 0; y < height / 2; ++y) std::swap_ranges(row(y), row(y) + width, row(height - 1 - y));
    if (mirroring.columns)
        for (uint32_t y = 0; y < height; ++y) std::reverse(row(y), row(y) + width);
}

// The grid of the window's samples.
GridPlacement moved_to(const GridPlacement& grid, const Window& window) {
    GridPlacement moved = grid;
    moved.origin_x += window.x * grid.column_x + window.y * grid.row_x;
    moved.origin_y += window.x * grid.column_y + window.y * grid.row_y;
    return moved;
}

struct Place {
    terrain::Frame frame;
    Mirroring mirroring;
};

// Where the window lies, and how it must be mirrored to lie so.
Result<Place> place_of(const GeoTiffTags& tags, const Window& window, const std::string& name) {
    Result<Crs> crs = crs_from_keys(tags, name);
    if (!crs) return tl::unexpected(crs.error());
    Result<GridPlacement> grid = placement_from_tags(tags, name);
    if (!grid) return tl::unexpected(grid.error());
    Place place;
    place.mirroring = mirroring_of(*grid);
    const GridPlacement upright = mirrored(moved_to(*grid, window), place.mirroring, window.width, window.height);
    Result<terrain::Frame> frame = frame_of(*crs, upright, window.width, window.height, name);
    if (!frame) return tl::unexpected(frame.error());
    place.frame = std::move(*frame);
    return place;
}

}  // namespace

Result<Stored> read_geotiff(const InputFile& file, const Options& options) {
    Result<GeoTiffTags> tags = read_geotiff_tags(file.bytes, file.path);
    if (!tags) return tl::unexpected(tags.error());
    if (auto form = check_form(*tags, file.path); !form) return tl::unexpected(form.error());
    Result<Window> window = window_of(options, tags->width, tags->height, file.path);
    if (!window) return tl::unexpected(window.error());

    Stored stored;
    Result<std::optional<double>> nodata = nodata_from_tags(*tags, options, file.path);
    if (!nodata) return tl::unexpected(nodata.error());
    stored.nodata = *nodata;
    Result<double> height_scale_m =
        options.height_scale_m ? Result<double>(*options.height_scale_m) : height_scale_from_keys(*tags, file.path);
    if (!height_scale_m) return tl::unexpected(height_scale_m.error());
    Result<ValueScale> values =
        options.height_scale_m ? Result<ValueScale>(ValueScale{}) : value_scale_of(tags->gdal_metadata, file.path);
    if (!values) return tl::unexpected(values.error());
    stored.height_scale_m = *height_scale_m * values->scale;
    stored.height_offset_m = *height_scale_m * values->offset;
    Result<Place> place =
        options.cell_size_m ? Result<Place>(Place{plain_frame(*options.cell_size_m), {}}) : place_of(*tags, *window, file.path);
    if (!place) return tl::unexpected(place.error());
    stored.frame = std::move(place->frame);

    Result<NumberRaster> numbers = read_number_raster(file.path, {window->x, window->y, window->width, window->height});
    if (!numbers) return tl::unexpected(numbers.error());
    stored.width = numbers->width;
    stored.height = numbers->height;
    stored.samples = std::move(numbers->values);
    stored.samples_are_integers = numbers->values_are_integers;
    mirror(stored.samples, stored.width, stored.height, place->mirroring);
    return stored;
}

}  // namespace overlook::dem
