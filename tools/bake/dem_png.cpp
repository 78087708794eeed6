// Grey PNG as an elevation model: heights without a reference. Source: W3C, "Portable Network Graphics (PNG) Specification",
// 2003.

#include <cstdint>

#include "tools/bake/dem_forms.h"
#include "tools/bake/images.h"
#include "tools/bake/png_check.h"

namespace overlook::dem {
namespace {

uint32_t big_endian_32(std::span<const std::byte> bytes, size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<uint32_t>(bytes[at + i]);
    return value;
}

// Only grey is a height. Fewer than 8 bits would be stretched in decoding, a palette says colours.
Result<void> check_grey(int bit_depth, int colour_type, const std::string& name) {
    constexpr int kGrey = 0, kPalette = 3;
    if (colour_type == kPalette)
        return bad_input("{}: its samples are numbers of palette colours, not heights; convert it to 8- or 16-bit grey", name);
    if (colour_type != kGrey)
        return bad_input("{}: is a PNG with {}, an elevation model has one channel; convert it to 8- or 16-bit grey", name,
                         colour_type == 4 ? "alpha" : "colours");
    if (bit_depth != 8 && bit_depth != 16)
        return bad_input("{}: has {} bits a sample; read are grey PNGs of 8 and 16", name, bit_depth);
    return {};
}

}  // namespace

Result<Stored> read_png(const InputFile& file, const Options& options) {
    if (auto whole = check_png(file.bytes, file.path); !whole) return tl::unexpected(whole.error());
    const uint32_t width = big_endian_32(file.bytes, 16), height = big_endian_32(file.bytes, 20);
    if (auto grey = check_grey(std::to_integer<int>(file.bytes[24]), std::to_integer<int>(file.bytes[25]), file.path); !grey)
        return tl::unexpected(grey.error());
    if (!options.cell_size_m)
        return bad_input("{}: a PNG does not say how large its cells are; give their size with --cell-size-m", file.path);
    Result<Window> window = window_of(options, width, height, file.path);
    if (!window) return tl::unexpected(window.error());
    Result<NumberRaster> numbers = read_number_raster(file.path, {window->x, window->y, window->width, window->height});
    if (!numbers) return tl::unexpected(numbers.error());

    Stored stored;
    stored.width = numbers->width;
    stored.height = numbers->height;
    stored.samples = std::move(numbers->values);
    stored.samples_are_integers = numbers->values_are_integers;
    stored.frame = plain_frame(*options.cell_size_m);
    return stored;
}

}  // namespace overlook::dem
