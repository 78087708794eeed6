// The module overlook_images.so: OpenImageIO, whose only source file in the bakers is this one.

#include "tools/bake/image_library.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>

namespace overlook {
namespace {

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

constexpr uint64_t kMostSamples = uint64_t(1) << 31;

// Messages of the library may have several lines, and name the file again: their first words, on one line.
std::string gist(std::string text) {
    std::string line;
    for (const char c : text) line.push_back(c == '\n' || c == '\r' || c == '\t' ? ' ' : c);
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (line.size() > 200) line = line.substr(0, 200) + "...";
    return line.empty() ? "it does not decode" : line;
}

// An opened image. The library prints an error that nobody fetched, so closing fetches it.
struct OpenImage {
    std::unique_ptr<ImageInput> input;
    ImageSpec spec;
    std::string path;

    OpenImage() = default;
    OpenImage(OpenImage&&) = default;
    OpenImage& operator=(OpenImage&&) = default;
    ~OpenImage() {
        if (input) input->geterror();
    }
    tl::unexpected<Error> failure() const { return bad_input("{}: cannot be decoded: {}", path, gist(input->geterror())); }
};

Result<OpenImage> open_image(const PictureFile& file) {
    const std::string& path = file.path;
    OpenImage image;
    image.path = path;
    image.input = ImageInput::create(file.reader);
    if (!image.input) {
        OIIO::geterror();
        return bad_input("{}: is no picture of a known form", path);
    }
    image.input->threads(file.thread_count);
    ImageSpec as_stored;
    as_stored.attribute("oiio:RawColor", 1);
    as_stored.attribute("oiio:UnassociatedAlpha", 1);
    if (!image.input->open(path, image.spec, as_stored)) return image.failure();
    const ImageSpec& spec = image.spec;
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels <= 0)
        return bad_input("{}: its size is {} x {} x {} with {} channels", path, spec.width, spec.height, spec.depth,
                         spec.nchannels);
    return image;
}

// Rows [begin, end) of columns [left, right) in the type that the file stores, in a buffer of all rows that had to be decoded.
struct Band {
    std::vector<std::byte> bytes;
    uint32_t first_row = 0;
    uint32_t first_column = 0;
    size_t bytes_per_row = 0;
};

// Reads the tiles, or the whole rows, that cover part of an image. Cost: samples decoded.
Result<Band> read_band(OpenImage& image, const ImageWindow& part) {
    const ImageSpec& spec = image.spec;
    const uint32_t tile_width = spec.tile_width > 0 ? uint32_t(spec.tile_width) : uint32_t(spec.width);
    const uint32_t tile_height = spec.tile_width > 0 ? uint32_t(spec.tile_height) : 1;
    const auto down_to = [](uint32_t value, uint32_t step) { return value / step * step; };
    const auto up_to = [](uint32_t value, uint32_t step, uint32_t most) {
        return uint32_t(std::min<uint64_t>((uint64_t(value) + step - 1) / step * step, most));
    };
    const uint32_t left = down_to(part.x, tile_width), right = up_to(part.x + part.width, tile_width, uint32_t(spec.width));
    const uint32_t top = down_to(part.y, tile_height), bottom = up_to(part.y + part.height, tile_height, uint32_t(spec.height));

    Band band;
    band.first_row = top;
    band.first_column = left;
    band.bytes_per_row = size_t(right - left) * size_t(spec.nchannels) * spec.format.size();
    band.bytes.resize(band.bytes_per_row * (bottom - top));
    const int x0 = spec.x + int(left), x1 = spec.x + int(right), y0 = spec.y + int(top), y1 = spec.y + int(bottom);
    const bool is_read =
        spec.tile_width > 0
            ? image.input->read_tiles(0, 0, x0, x1, y0, y1, spec.z, spec.z + 1, 0, spec.nchannels, spec.format, band.bytes.data())
            : image.input->read_scanlines(0, 0, y0, y1, spec.z, 0, spec.nchannels, spec.format, band.bytes.data());
    if (!is_read || image.input->has_error()) return image.failure();
    return band;
}

// How many rows to decode at a time: whole tiles, and enough rows that a strip is seldom decoded twice.
uint32_t rows_at_a_time(const ImageSpec& spec) {
    if (spec.tile_width > 0) return uint32_t(spec.tile_height);
    const int strip = spec.get_int_attribute("tiff:RowsPerStrip", 1);
    const uint32_t rows = uint32_t(std::clamp(strip, 1, spec.height));
    return (64 + rows - 1) / rows * rows;
}

// Calls take(band, row) for every row of a window, top to bottom.
template <class Take>
Result<void> for_each_row(OpenImage& image, const ImageWindow& window, const Take& take) {
    const uint32_t step = rows_at_a_time(image.spec);
    const uint32_t end = window.y + window.height;
    for (uint32_t y = window.y; y < end;) {
        const uint32_t next = uint32_t(std::min<uint64_t>((uint64_t(y) / step + 1) * step, end));
        Result<Band> band = read_band(image, {window.x, y, window.width, next - y});
        if (!band) return tl::unexpected(band.error());
        for (; y < next; ++y) take(*band, y);
    }
    return {};
}

template <class T>
void convert_row(const std::byte* from, uint32_t count, float* to) {
    for (uint32_t i = 0; i < count; ++i) {
        T value;
        std::memcpy(&value, from + i * sizeof(T), sizeof(T));
        to[i] = float(value);
    }
}

using Convert = void (*)(const std::byte* from, uint32_t count, float* to);
Convert converter_of(TypeDesc type) {
    switch (type.basetype) {
        case TypeDesc::INT8:
            return convert_row<int8_t>;
        case TypeDesc::UINT8:
            return convert_row<uint8_t>;
        case TypeDesc::INT16:
            return convert_row<int16_t>;
        case TypeDesc::UINT16:
            return convert_row<uint16_t>;
        case TypeDesc::FLOAT:
            return convert_row<float>;
        default:
            return nullptr;
    }
}

Result<ImageWindow> resolved(const OpenImage& image, const ImageWindow& window) {
    const uint32_t width = uint32_t(image.spec.width), height = uint32_t(image.spec.height);
    const ImageWindow part = window.width == 0 ? ImageWindow{0, 0, width, height} : window;
    if (part.height == 0 || part.x > width || part.width > width - part.x || part.y > height || part.height > height - part.y)
        return bad_input("{}: the window {},{} {}x{} reaches beyond the raster, which has {} x {} samples", image.path, part.x,
                         part.y, part.width, part.height, width, height);
    if (uint64_t(part.width) * part.height > kMostSamples)
        return impossible("{}: {} x {} samples are more than the {} that fit; read it in parts with --window", image.path,
                          part.width, part.height, kMostSamples);
    return part;
}

Result<NumberRaster> read_numbers(const PictureFile& file, const ImageWindow& window) {
    const std::string& path = file.path;
    Result<OpenImage> image = open_image(file);
    if (!image) return tl::unexpected(image.error());
    const ImageSpec& spec = image->spec;
    if (spec.nchannels != 1)
        return bad_input("{}: has {} channels, an elevation model has one; is it a picture?", path, spec.nchannels);
    const Convert convert = converter_of(spec.format);
    if (!convert || !spec.channelformats.empty())
        return bad_input("{}: its samples are of type {}; read are 8- and 16-bit integers and 32-bit floats", path,
                         spec.format.c_str());
    Result<ImageWindow> part = resolved(*image, window);
    if (!part) return tl::unexpected(part.error());

    NumberRaster raster;
    raster.width = part->width;
    raster.height = part->height;
    raster.values_are_integers = spec.format != TypeDesc::FLOAT;
    raster.values.resize(size_t(part->width) * part->height);
    const auto read = for_each_row(*image, *part, [&](const Band& band, uint32_t y) {
        const std::byte* from =
            band.bytes.data() + band.bytes_per_row * (y - band.first_row) + (part->x - band.first_column) * spec.format.size();
        convert(from, part->width, raster.values.data() + size_t(part->width) * (y - part->y));
    });
    if (!read) return tl::unexpected(read.error());
    return raster;
}

// One row of any type and number of channels as 8-bit RGB.
void spread_to_rgb(const uint8_t* from, uint32_t count, int channels, uint8_t* to) {
    for (uint32_t i = 0; i < count; ++i, from += channels, to += 3) {
        to[0] = from[0];
        to[1] = channels >= 3 ? from[1] : from[0];
        to[2] = channels >= 3 ? from[2] : from[0];
    }
}

Result<ImageRgb8> read_rgb8(const PictureFile& file) {
    Result<OpenImage> image = open_image(file);
    if (!image) return tl::unexpected(image.error());
    const ImageSpec& spec = image->spec;
    Result<ImageWindow> part = resolved(*image, {});
    if (!part) return tl::unexpected(part.error());

    ImageRgb8 picture;
    picture.width = part->width;
    picture.height = part->height;
    picture.pixels.resize(size_t(3) * part->width * part->height);
    std::vector<uint8_t> row(size_t(part->width) * size_t(spec.nchannels));
    const auto read = for_each_row(*image, *part, [&](const Band& band, uint32_t y) {
        OIIO::convert_pixel_values(spec.format, band.bytes.data() + band.bytes_per_row * (y - band.first_row), TypeDesc::UINT8,
                                   row.data(), int(row.size()));
        spread_to_rgb(row.data(), part->width, spec.nchannels, picture.pixels.data() + size_t(3) * part->width * y);
    });
    if (!read) return tl::unexpected(read.error());
    return picture;
}

// An image from memory, which must outlive it; failing that, its reader holds the reason.
bool open_memory(const PictureFile& file, OIIO::Filesystem::IOMemReader& memory, OpenImage& image) {
    image.path = file.path;
    image.input = ImageInput::create(file.reader);
    OIIO::geterror();
    ImageSpec as_stored;
    as_stored.attribute("oiio:UnassociatedAlpha", 1);
    return image.input && image.input->set_ioproxy(&memory) && image.input->open(file.path, image.spec, as_stored) &&
           image.spec.width > 0 && image.spec.height > 0;
}

Result<PictureRgba8> read_rgba8(const PictureFile& file, std::span<const std::byte> bytes) {
    constexpr uint64_t kMostPixels = uint64_t(1) << 26;
    OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
    OpenImage image;
    if (!open_memory(file, memory, image))
        return bad_input("{}: cannot be decoded: {}", file.path, gist(image.input ? image.input->geterror() : ""));
    auto width = uint32_t(image.spec.width), height = uint32_t(image.spec.height);
    uint64_t count = uint64_t(width) * height, channels = uint64_t(std::max(image.spec.nchannels, 1));
    if (count > kMostPixels || channels > 16)
        return bad_input("{}: has {} x {} pixels, at most {} in all are read", file.path, width, height, kMostPixels);
    std::vector<uint8_t> stored(count * channels);
    if (!image.input->read_image(0, 0, 0, int(channels), TypeDesc::UINT8, stored.data())) return image.failure();
    PictureRgba8 picture{width, height, std::vector<uint8_t>(4 * count)};
    for (uint64_t i = 0; i < count; ++i) {
        const uint8_t* from = stored.data() + i * channels;
        for (size_t c = 0; c < 3; ++c) picture.pixels[4 * i + c] = from[channels >= 3 ? c : 0];
        picture.pixels[4 * i + 3] = channels == 2 ? from[1] : channels >= 4 ? from[3] : uint8_t(255);
    }
    image.input->close();
    return picture;
}

std::optional<PictureSize> size_of(const PictureFile& file, std::span<const std::byte> bytes) {
    OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(bytes.data()), bytes.size());
    OpenImage image;
    if (!open_memory(file, memory, image)) return std::nullopt;
    PictureSize size{uint32_t(image.spec.width), uint32_t(image.spec.height)};
    image.input->close();
    return size;
}

Result<std::vector<std::byte>> write_png(uint32_t width, uint32_t height, int channels, std::span<const uint8_t> pixels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
    ImageSpec spec(int(width), int(height), channels, TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    bool is_written = output && output->set_ioproxy(&memory) && output->open("picture.png", spec) &&
                      output->write_image(TypeDesc::UINT8, pixels.data()) && output->close();
    if (!is_written)
        return cannot_write("a picture of {} x {} pixels cannot be written as PNG: {}", width, height,
                            gist(output ? output->geterror() : OIIO::geterror()));
    std::span<const std::byte> written = std::as_bytes(std::span(bytes));
    return std::vector<std::byte>(written.begin(), written.end());
}

// Runs a reader and turns what the library throws into an error.
template <class Read>
auto guarded(const std::string& path, const Read& read) -> decltype(read()) {
    try {
        return read();
    } catch (const std::bad_alloc&) {
        return impossible("{}: does not fit into memory; read it in parts with --window", path);
    } catch (const std::length_error&) {
        return impossible("{}: does not fit into memory; read it in parts with --window", path);
    } catch (const std::exception& problem) {
        return bad_input("{}: cannot be decoded: {}", path, gist(problem.what()));
    }
}

constexpr ImageLibrary kLibrary = {
    .version = OVERLOOK_VERSION,
    .read_numbers = [](const PictureFile& file,
                       const ImageWindow& window) { return guarded(file.path, [&] { return read_numbers(file, window); }); },
    .read_rgb8 = [](const PictureFile& file) { return guarded(file.path, [&] { return read_rgb8(file); }); },
    .read_rgba8 = [](const PictureFile& file,
                     std::span<const std::byte> bytes) { return guarded(file.path, [&] { return read_rgba8(file, bytes); }); },
    .size_of = size_of,
    .write_png = write_png,
};

}  // namespace
}  // namespace overlook

// The module hides all else.
extern "C" [[gnu::visibility("default")]] const overlook::ImageLibrary* overlook_image_library() {
    return &overlook::kLibrary;
}
