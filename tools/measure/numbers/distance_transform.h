// How far every pixel is from the nearest marked one, exactly.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace overlook::measure {

constexpr uint32_t kNoneMarked = std::numeric_limits<uint32_t>::max();

// marked: [height, width], not 0 = marked; sides 1..32768. Squared Euclidean distance in pixels between pixel middles,
// [height, width]; kNoneMarked everywhere if nothing is marked. O(pixels), in whole numbers: exact.
// Source: Felzenszwalb, Huttenlocher, "Distance Transforms of Sampled Functions", Theory of Computing 8, 2012.
std::vector<uint32_t> squared_distances_px(uint32_t width, uint32_t height, std::span<const uint8_t> marked);

}  // namespace overlook::measure
