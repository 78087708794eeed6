// Percentiles, one rule for all numbers.
#pragma once

#include <span>

namespace overlook::measure {

// Nearest rank: the smallest value that at least `share` (0..1) of all values do not exceed. It is one of the values, so the
// frame or pixel that has it can be shown; the median of an even count is the lower of the middle two. 0 for none. O(n).
double percentile(std::span<const double> values, double share);
float percentile(std::span<const float> values, double share);

struct Percentiles {
    double p50 = 0, p95 = 0, p99 = 0, max = 0;
};
Percentiles percentiles_of(std::span<const double> values);

}  // namespace overlook::measure
