// The tags of a GeoTIFF. Source: OGC 19-008r4, "OGC GeoTIFF Standard 1.1", 2019.

#include "tools/bake/geotiff_tags.h"

#include <algorithm>
#include <cmath>

#include "tools/bake/tiff_directory.h"

namespace overlook::dem {
namespace {

constexpr uint16_t kImageWidth = 256, kImageLength = 257, kBitsPerSample = 258, kCompression = 259, kPhotometric = 262,
                   kStripOffsets = 273, kSamplesPerPixel = 277, kRowsPerStrip = 278, kStripByteCounts = 279,
                   kPlanarConfiguration = 284, kTileWidth = 322, kTileLength = 323, kTileOffsets = 324, kTileByteCounts = 325,
                   kSampleFormat = 339, kModelPixelScale = 33550, kModelTiepoint = 33922, kModelTransformation = 34264,
                   kGeoKeyDirectory = 34735, kGeoDoubleParams = 34736, kGeoAsciiParams = 34737, kOrientation = 274,
                   kGdalMetadata = 42112, kGdalNodata = 42113;

// No compression that OpenImageIO decodes makes samples this many times smaller; a file that claims more is damaged, and would
// only make us allocate what it does not hold. (zstd's runs: 128 KiB in 4 bytes.)
constexpr double kGreatestCompression = 40000;

// Reads one integer into `value`, refusing what is outside [least, most].
Result<void> read_integer(const TiffDirectory& directory, uint16_t tag, const char* what, uint32_t otherwise, uint64_t least,
                          uint64_t most, uint32_t& value) {
    Result<uint64_t> read = tiff_integer(directory, tag, what, otherwise);
    if (!read) return tl::unexpected(read.error());
    if (*read < least || *read > most) return bad_input("{}: TIFF tag {} ({}) is {}", directory.name, tag, what, *read);
    value = uint32_t(*read);
    return {};
}

// A tag with one value for each channel, which must be the same for all.
Result<void> read_per_channel(const TiffDirectory& directory, uint16_t tag, const char* what, uint64_t most, uint32_t& value) {
    Result<std::vector<uint64_t>> read = tiff_integers(directory, tag, what);
    if (!read) return tl::unexpected(read.error());
    if (read->empty()) return {};
    if (std::adjacent_find(read->begin(), read->end(), std::not_equal_to<>()) != read->end())
        return bad_input("{}: TIFF tag {} ({}) differs from channel to channel", directory.name, tag, what);
    if (read->front() == 0 || read->front() > most)
        return bad_input("{}: TIFF tag {} ({}) is {}", directory.name, tag, what, read->front());
    value = uint32_t(read->front());
    return {};
}

Result<void> read_form(const TiffDirectory& directory, GeoTiffTags& tags) {
    constexpr uint64_t kMostSide = 0x7fffffff;
    if (auto r = read_integer(directory, kImageWidth, "ImageWidth", 0, 1, kMostSide, tags.width); !r) return r;
    if (auto r = read_integer(directory, kImageLength, "ImageLength", 0, 1, kMostSide, tags.height); !r) return r;
    if (auto r = read_integer(directory, kSamplesPerPixel, "SamplesPerPixel", 1, 1, 65535, tags.samples_per_pixel); !r) return r;
    if (auto r = read_integer(directory, kPhotometric, "PhotometricInterpretation", 1, 0, 65535, tags.photometric); !r) return r;
    if (auto r = read_per_channel(directory, kBitsPerSample, "BitsPerSample", 64, tags.bits_per_sample); !r) return r;
    uint32_t format = 1;
    if (auto r = read_per_channel(directory, kSampleFormat, "SampleFormat", 3, format); !r) return r;
    tags.sample_format = SampleFormat(format);
    return {};
}

// How the samples are cut into strips or tiles.
struct Pieces {
    const char* what = "strip";
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint64_t> offsets;
    std::vector<uint64_t> byte_counts;
};

Result<Pieces> read_pieces(const TiffDirectory& directory, const GeoTiffTags& tags) {
    Pieces pieces;
    uint32_t tile_width = 0;
    if (auto r = read_integer(directory, kTileWidth, "TileWidth", 0, 0, 1u << 20, tile_width); !r)
        return tl::unexpected(r.error());
    const bool is_tiled = tile_width != 0;
    pieces.what = is_tiled ? "tile" : "strip";
    pieces.width = is_tiled ? tile_width : tags.width;
    const auto height = is_tiled
                            ? read_integer(directory, kTileLength, "TileLength", 0, 1, 1u << 20, pieces.height)
                            : read_integer(directory, kRowsPerStrip, "RowsPerStrip", tags.height, 1, 0xffffffff, pieces.height);
    if (!height) return tl::unexpected(height.error());
    if (!is_tiled) pieces.height = std::min(pieces.height, tags.height);

    Result<std::vector<uint64_t>> offsets = is_tiled ? tiff_integers(directory, kTileOffsets, "TileOffsets")
                                                     : tiff_integers(directory, kStripOffsets, "StripOffsets");
    if (!offsets) return tl::unexpected(offsets.error());
    Result<std::vector<uint64_t>> counts = is_tiled ? tiff_integers(directory, kTileByteCounts, "TileByteCounts")
                                                    : tiff_integers(directory, kStripByteCounts, "StripByteCounts");
    if (!counts) return tl::unexpected(counts.error());
    pieces.offsets = std::move(*offsets);
    pieces.byte_counts = std::move(*counts);
    return pieces;
}

// Every strip or tile lies within the file and could hold its samples.
Result<void> check_pieces(const TiffDirectory& directory, const GeoTiffTags& tags) {
    Result<Pieces> pieces = read_pieces(directory, tags);
    if (!pieces) return tl::unexpected(pieces.error());
    uint32_t compression = 1, planar = 1;
    if (auto r = read_integer(directory, kCompression, "Compression", 1, 0, 65535, compression); !r) return r;
    if (auto r = read_integer(directory, kPlanarConfiguration, "PlanarConfiguration", 1, 1, 2, planar); !r) return r;

    const uint64_t across = (uint64_t(tags.width) + pieces->width - 1) / pieces->width;
    const uint64_t down = (uint64_t(tags.height) + pieces->height - 1) / pieces->height;
    const uint64_t planes = planar == 2 ? tags.samples_per_pixel : 1;
    const bool is_countable = across * down <= directory.bytes.size();  // each takes a byte at least; sides are below 2^31
    const uint64_t expected = is_countable ? across * down * planes : across * down;
    if (!is_countable || pieces->offsets.size() != expected || pieces->byte_counts.size() != expected)
        return bad_input("{}: a raster of {} x {} in {}s of {} x {} needs {} of them, the file lists {}", directory.name,
                         tags.width, tags.height, pieces->what, pieces->width, pieces->height, expected,
                         std::min(pieces->offsets.size(), pieces->byte_counts.size()));

    const uint64_t total = directory.bytes.size();
    const double bytes_per_pixel = double(tags.bits_per_sample) * (planar == 2 ? 1 : tags.samples_per_pixel) / 8;
    for (uint64_t i = 0; i < expected; ++i) {
        const uint64_t offset = pieces->offsets[size_t(i)], size = pieces->byte_counts[size_t(i)];
        if (size == 0 || offset == 0)
            return bad_input("{}: TIFF {} {} is empty (a sparse file); write it whole, with gdal_translate -co SPARSE_OK=FALSE",
                             directory.name, pieces->what, i);
        if (size > total || offset > total - size)
            return bad_input(
                "{}: TIFF {} {} (from byte {}, {} bytes) ends after the file, which is {} bytes long; was the copy cut short?",
                directory.name, pieces->what, i, offset, size, total);
        const bool is_last_strip = tags.width == pieces->width && i % down == down - 1 && pieces->what[0] == 's';
        const double rows = is_last_strip ? double(tags.height - (down - 1) * pieces->height) : double(pieces->height);
        const double needed = std::floor(bytes_per_pixel * pieces->width * rows);
        if (double(size) < (compression == 1 ? needed : needed / kGreatestCompression))
            return bad_input("{}: TIFF {} {} has {} bytes, too few for its {} x {} samples", directory.name, pieces->what, i,
                             size, pieces->width, rows);
    }
    return {};
}

// The words of the file about its reference, without what would break a line.
std::string printable(std::string_view text) {
    std::string result;
    for (const char c : text.substr(0, 120))
        if (c >= ' ' && c <= '~') result.push_back(c);
    return result;
}

Result<void> read_keys(const TiffDirectory& directory, GeoTiffTags& tags) {
    Result<std::vector<uint64_t>> words = tiff_integers(directory, kGeoKeyDirectory, "GeoKeyDirectory");
    if (!words) return tl::unexpected(words.error());
    if (words->empty()) return {};
    Result<std::vector<double>> doubles = tiff_doubles(directory, kGeoDoubleParams, "GeoDoubleParams");
    if (!doubles) return tl::unexpected(doubles.error());
    Result<std::string> text = tiff_text(directory, kGeoAsciiParams, "GeoAsciiParams");
    if (!text) return tl::unexpected(text.error());

    const std::vector<uint64_t>& w = *words;
    const auto broken = [&](const std::string& why) {
        return bad_input("{}: TIFF tag {} (GeoKeyDirectory) {}", directory.name, kGeoKeyDirectory, why);
    };
    if (w.size() < 4) return broken(fmt::format("has {} numbers, fewer than its head of 4", w.size()));
    if (w[3] > (w.size() - 4) / 4) return broken(fmt::format("announces {} keys, {} numbers hold fewer", w[3], w.size()));
    for (size_t i = 4; i < 4 + 4 * size_t(w[3]); i += 4) {
        const uint64_t id = w[i], location = w[i + 1], count = w[i + 2], value = w[i + 3];
        if (id > 65535 || value > 65535 || count > 65535) return broken(fmt::format("has a number above 65535 in key {}", id));
        if (location == 0) tags.keys.push_back({uint16_t(id), uint16_t(value)});
        if (location == kGeoDoubleParams && value + count > doubles->size())
            return broken(fmt::format("points outside tag {} in key {}", location, id));
        const bool is_citation = id == kGtCitation || id == kGeogCitation || id == kProjectedCitation;
        if (location == kGeoAsciiParams && is_citation && tags.citation.empty() && value < text->size())
            tags.citation = printable(std::string_view(*text).substr(size_t(value), count ? size_t(count) - 1 : 0));
    }
    std::stable_sort(tags.keys.begin(), tags.keys.end(), [](const GeoKey& a, const GeoKey& b) { return a.id < b.id; });
    return {};
}

// Doubles of a tag that has none or a number of values that `is_right`; all must be finite.
Result<void> read_doubles(const TiffDirectory& directory, uint16_t tag, const char* what, bool (*is_right)(size_t),
                          std::vector<double>& values) {
    Result<std::vector<double>> read = tiff_doubles(directory, tag, what);
    if (!read) return tl::unexpected(read.error());
    if (!is_right(read->size())) return bad_input("{}: TIFF tag {} ({}) has {} values", directory.name, tag, what, read->size());
    if (!std::all_of(read->begin(), read->end(), [](double value) { return std::isfinite(value); }))
        return bad_input("{}: TIFF tag {} ({}) holds a value that is not a number", directory.name, tag, what);
    values = std::move(*read);
    return {};
}

}  // namespace

std::optional<uint16_t> GeoTiffTags::key(uint16_t id) const {
    for (const GeoKey& candidate : keys)
        if (candidate.id == id) return candidate.value;
    return std::nullopt;
}

Result<GeoTiffTags> read_geotiff_tags(std::span<const std::byte> bytes, const std::string& name) {
    Result<TiffDirectory> directory = read_tiff_directory(bytes, name);
    if (!directory) return tl::unexpected(directory.error());
    GeoTiffTags tags;
    if (auto r = read_form(*directory, tags); !r) return tl::unexpected(r.error());
    if (auto r = check_pieces(*directory, tags); !r) return tl::unexpected(r.error());
    const auto none_or_3 = [](size_t n) { return n == 0 || n == 3; };
    const auto sixes = [](size_t n) { return n % 6 == 0; };
    const auto none_or_16 = [](size_t n) { return n == 0 || n == 16; };
    if (auto r = read_doubles(*directory, kModelPixelScale, "ModelPixelScale", none_or_3, tags.pixel_scale); !r)
        return tl::unexpected(r.error());
    if (auto r = read_doubles(*directory, kModelTiepoint, "ModelTiepoint", sixes, tags.tie_points); !r)
        return tl::unexpected(r.error());
    if (auto r = read_doubles(*directory, kModelTransformation, "ModelTransformation", none_or_16, tags.transformation); !r)
        return tl::unexpected(r.error());
    if (auto r = read_keys(*directory, tags); !r) return tl::unexpected(r.error());
    Result<std::string> nodata = tiff_text(*directory, kGdalNodata, "GDAL_NODATA");
    if (!nodata) return tl::unexpected(nodata.error());
    if (!nodata->empty()) tags.nodata = std::move(*nodata);
    Result<std::string> metadata = tiff_text(*directory, kGdalMetadata, "GDAL_METADATA");
    if (!metadata) return tl::unexpected(metadata.error());
    tags.gdal_metadata = std::move(*metadata);
    Result<std::vector<uint64_t>> orientation = tiff_integers(*directory, kOrientation, "Orientation");
    if (!orientation) return tl::unexpected(orientation.error());
    if (!orientation->empty()) tags.orientation = uint32_t(std::min<uint64_t>(orientation->front(), 9));
    return tags;
}

}  // namespace overlook::dem
