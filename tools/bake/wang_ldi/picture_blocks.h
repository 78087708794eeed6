// The pixels of a picture in the order in which their rays are shot.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace overlook::wang_ldi {

// All pixels, row * width + column, in blocks of 4 x 4, whose rays go about the same way.
inline std::vector<uint32_t> pixels_by_block(uint32_t width, uint32_t height) {
    constexpr uint32_t kBlock = 4;
    std::vector<uint32_t> pixels;
    pixels.reserve(size_t(width) * height);
    for (uint32_t top = 0; top < height; top += kBlock)
        for (uint32_t left = 0; left < width; left += kBlock)
            for (uint32_t y = top; y < std::min(top + kBlock, height); ++y)
                for (uint32_t x = left; x < std::min(left + kBlock, width); ++x) pixels.push_back(y * width + x);
    return pixels;
}

}  // namespace overlook::wang_ldi
