// Pictures and rasters of numbers in, and pictures out, through OpenImageIO, which is in a module of its own that the first call
// here opens (image_module.h); where it cannot be opened each function fails with image_library()'s error.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/image.h"
#include "formats/result.h"

namespace overlook {

// The first channel of an image as floats, exactly as stored (no scaling of integers to 0..1).
struct NumberRaster {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<float> values;  // [height, width] row-major, top row first
    bool values_are_integers = false;
};

// Part of an image, in pixels; width 0 = all of it.
struct ImageWindow {
    uint32_t x = 0, y = 0, width = 0, height = 0;
};

Result<NumberRaster> read_number_raster(const std::string& path, const ImageWindow& window);

// Any picture that OpenImageIO reads, as 8-bit RGB. Grey is spread to three channels, alpha is dropped, 16 bits are
// rounded to 8.
Result<ImageRgb8> read_image_rgb8(const std::string& path);

// A picture file's bytes as 8-bit RGBA, as stored: colours are not multiplied by opacity, which is 255 where there is none.
struct PictureRgba8 {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> pixels;  // [height, width, 4], top row first
};
// `bytes` may be hostile. Fails with Exit::bad_input, as read_image_rgb8 does, and for more than 2^26 pixels: "leaf.png: has
// 90000 x 90000 pixels, at most 67108864 in all are read".
Result<PictureRgba8> picture_rgba8(const std::string& name, std::span<const std::byte> bytes);

// Width and height in pixels of a picture file's bytes (PNG, JPEG and what else OpenImageIO reads; `name` tells by its extension
// where the bytes do not). Reads the header alone. Nothing where it is no picture; bytes that cannot be one open no module.
struct PictureSize {
    uint32_t width_px = 0, height_px = 0;
};
Result<std::optional<PictureSize>> picture_size(const std::string& name, std::span<const std::byte> bytes);

// A picture as a PNG file's bytes: 8-bit RGB, sRGB. width and height >= 1. Same picture, same bytes: no date, no program's name.
// Fails with Exit::cannot_write: "a picture of 512 x 512 pixels cannot be written as PNG: ..." with the library's reason.
Result<std::vector<std::byte>> png_bytes(const ImageRgb8& image);
// The same of pixels [height, width, channels]; 4 channels: the last is opacity, which the colours are not multiplied by.
Result<std::vector<std::byte>> png_bytes(uint32_t width, uint32_t height, int channels, std::span<const uint8_t> pixels);

}  // namespace overlook
