// PNG files in and out, through libspng (whose only source file in the runtime is png.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/image.h"
#include "formats/result.h"

namespace overlook {

// Writes an 8-bit RGB PNG, marked sRGB; it appears under its name only when it is whole. Same image, same bytes.
// image: width and height >= 1. Fails with Exit::cannot_write: "out/a.png: cannot write: No space left on device".
Result<void> write_png(const std::string& path, const ImageRgb8& image);

// Eight-bit RGBA as a PNG stores it, top row first.
struct ImageRgba8 {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> pixels;  // [height, width, 4]
};
// Decodes a PNG of at most 16,384 pixels a side. `bytes` may be hostile. Fails with Exit::bad_input: "bark.png: is no picture
// that can be read: invalid header; PNG is wanted".
Result<ImageRgba8> decode_png(const std::string& name, std::span<const std::byte> bytes);

}  // namespace overlook
