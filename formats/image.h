// An 8-bit RGB picture in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace overlook {

// pixels: [height, width, 3] row-major, top row (north) first, sRGB-encoded.
struct ImageRgb8 {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> pixels;
};

}  // namespace overlook
