// One frame as the numbers see it: colour, depth, which thing, from where.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/view/camera.h"

namespace overlook::measure {

constexpr uint32_t kBackground = 0;  // id of a pixel in which nothing is drawn

// All planes: [height, width] row-major, top row first.
struct Frame {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgb;    // [height, width, 3], sRGB-encoded
    std::vector<float> depth_m;  // along the camera's axis, of the surface nearest to the pixel's middle; infinity for background
    std::vector<uint32_t> ids;   // of the thing drawn, kBackground for none
    view::Camera camera;
};

}  // namespace overlook::measure
