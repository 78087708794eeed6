// PNG files out, through libspng (whose only source file in the runtime is png.cpp).
#pragma once

#include <string>

#include "formats/image.h"
#include "formats/result.h"

namespace overlook {

// Writes an 8-bit RGB PNG, marked sRGB; it appears under its name only when it is whole. Same image, same bytes.
// image: width and height >= 1. Fails with Exit::cannot_write: "out/a.png: cannot write: No space left on device".
Result<void> write_png(const std::string& path, const ImageRgb8& image);

}  // namespace overlook
