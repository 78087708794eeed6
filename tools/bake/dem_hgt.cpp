// SRTM tiles (.hgt): square, big-endian int16, samples on the corners of a one-degree cell that the file's name gives.
// Source: NASA, "SRTM Topography" (documentation of the SRTM data, version 2.1).

#include <cctype>
#include <cmath>

#include "tools/bake/dem_forms.h"
#include "tools/bake/georeference.h"

namespace overlook::dem {
namespace {

constexpr double kVoidOfHgt = -32768;

std::string lower_case(std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

struct Corner {
    int latitude_deg = 0;
    int longitude_deg = 0;
};

// The south-west corner that a name like "N44W072.hgt" or "s12e131.SRTMGL1.hgt" gives.
std::optional<Corner> corner_from_name(const std::string& path) {
    const std::string name = lower_case(path.substr(path.find_last_of('/') + 1));
    const auto digits = [&](size_t at, size_t count) {
        int value = 0;
        for (size_t i = at; i < at + count; ++i) {
            if (i >= name.size() || name[i] < '0' || name[i] > '9') return -1;
            value = value * 10 + (name[i] - '0');
        }
        return value;
    };
    if (name.size() < 8 || name[7] != '.' || (name[0] != 'n' && name[0] != 's') || (name[3] != 'e' && name[3] != 'w'))
        return std::nullopt;
    const int latitude = digits(1, 2), longitude = digits(4, 3);
    if (latitude < 0 || latitude > 90 || longitude < 0 || longitude > 180) return std::nullopt;
    const Corner corner{name[0] == 'n' ? latitude : -latitude, name[3] == 'e' ? longitude : -longitude};
    if (corner.latitude_deg > 89) return std::nullopt;
    return corner;
}

// Samples on a side of the square; 0 if the length is no square's.
uint64_t side_of(uint64_t bytes) {
    const uint64_t side = uint64_t(std::llround(std::sqrt(double(bytes / 2))));
    return side >= 2 && side * side * 2 == bytes ? side : 0;
}

int16_t sample_at(std::span<const std::byte> bytes, uint64_t index) {
    return int16_t(uint16_t(std::to_integer<unsigned>(bytes[index * 2]) << 8 | std::to_integer<unsigned>(bytes[index * 2 + 1])));
}

}  // namespace

bool is_hgt(const std::string& path) {
    return path.size() > 4 && lower_case(path.substr(path.size() - 4)) == ".hgt";
}

Result<Stored> read_hgt(const InputFile& file, const Options& options) {
    const uint64_t side = side_of(file.bytes.size());
    if (side == 0 || side > 0x7fffffff)
        return bad_input(
            "{}: is {} bytes long, which is no square of 16-bit samples (1201 x 1201 have 2884802); was the copy cut short?",
            file.path, file.bytes.size());
    const std::optional<Corner> corner = corner_from_name(file.path);
    if (!corner && !options.cell_size_m)
        return bad_input(
            "{}: its name is not that of an SRTM tile (N44W072.hgt), so where it lies is not known; rename it, or give the "
            "size of its cells with --cell-size-m",
            file.path);
    Result<Window> window = window_of(options, uint32_t(side), uint32_t(side), file.path);
    if (!window) return tl::unexpected(window.error());

    Stored stored;
    stored.width = window->width;
    stored.height = window->height;
    stored.samples_are_integers = true;
    stored.nodata = kVoidOfHgt;
    if (options.cell_size_m) {
        stored.frame = plain_frame(*options.cell_size_m);
    } else {
        const double step_deg = 1.0 / double(side - 1);
        const GridPlacement grid{corner->longitude_deg + window->x * step_deg,
                                 corner->latitude_deg + 1 - window->y * step_deg,
                                 step_deg,
                                 0,
                                 0,
                                 -step_deg};
        Result<terrain::Frame> frame = frame_of(*crs_from_epsg(4326), grid, window->width, window->height, file.path);
        if (!frame) return tl::unexpected(frame.error());
        stored.frame = *frame;
    }

    stored.samples.resize(size_t(window->width) * window->height);
    for (uint32_t row = 0; row < window->height; ++row)
        for (uint32_t column = 0; column < window->width; ++column)
            stored.samples[size_t(row) * window->width + column] =
                sample_at(file.bytes, (uint64_t(window->y) + row) * side + window->x + column);
    return stored;
}

}  // namespace overlook::dem
