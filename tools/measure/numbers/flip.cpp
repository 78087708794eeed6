#include "tools/measure/numbers/flip.h"

#include <algorithm>

#include "tools/measure/numbers/percentiles.h"

namespace overlook::measure {

FlipError flip(const RgbView& test, const RgbView& reference, double pixels_per_degree) {
    FlipError error{test.width, test.height, view::flip_map(test, reference, pixels_per_degree)};
    double sum = 0;
    for (float value : error.map) sum += double(value);
    error.mean = sum / double(error.map.size());
    error.p99 = double(percentile(std::span<const float>(error.map), 0.99));
    error.max = double(*std::max_element(error.map.begin(), error.map.end()));
    return error;
}

}  // namespace overlook::measure
