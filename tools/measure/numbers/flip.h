// E: how different two pictures look when one is flipped for the other, summed up.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/view/flip.h"
#include "tools/measure/numbers/picture.h"

namespace overlook::measure {

using view::kPixelsPerDegree;

struct FlipError {
    uint32_t width = 0, height = 0;
    std::vector<float> map;  // of view::flip_map
    double mean = 0, p99 = 0, max = 0;
};

// As view::flip_map.
FlipError flip(const RgbView& test, const RgbView& reference, double pixels_per_degree = kPixelsPerDegree);

}  // namespace overlook::measure
