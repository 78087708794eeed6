// Frames from the renderer.
#pragma once

#include "runtime/gl/target.h"
#include "tools/measure/frame.h"
#include "tools/measure/method.h"

namespace overlook::measure {

// The picture of `colour`, with depth and ids of `middle`, a target of the same size with one sample a pixel into which the same
// was drawn (it may be the same target).
Frame captured(const gl::Target& colour, const gl::Target& middle, const view::Camera& camera);

// The red channel, [height, width] top row first.
std::vector<uint8_t> mask_of(const gl::Target& target);

// Averages blocks of factor x factor pixels in linear light. width and height must be multiples of factor >= 1.
ImageRgb8 box_filtered(const ImageRgb8& image, uint32_t factor);

}  // namespace overlook::measure
