#include "tools/measure/numbers/percentiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace overlook::measure {
namespace {

// Which of n values in ascending order; a share like 0.95 is not exact in binary, so what is whole but for rounding is whole.
size_t rank_of(size_t count, double share) {
    double wanted = std::ceil(std::clamp(share, 0.0, 1.0) * double(count) * (1 - 1e-12));
    return std::min(count, std::max<size_t>(1, size_t(wanted))) - 1;
}

template <class T>
T value_at(std::span<const T> values, double share) {
    if (values.empty()) return 0;
    std::vector<T> copy(values.begin(), values.end());
    auto place = copy.begin() + ptrdiff_t(rank_of(copy.size(), share));
    std::nth_element(copy.begin(), place, copy.end());
    return *place;
}

}  // namespace

double percentile(std::span<const double> values, double share) {
    return value_at(values, share);
}

float percentile(std::span<const float> values, double share) {
    return value_at(values, share);
}

Percentiles percentiles_of(std::span<const double> values) {
    if (values.empty()) return {};
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    auto at = [&](double share) { return sorted[rank_of(sorted.size(), share)]; };
    return {at(0.5), at(0.95), at(0.99), sorted.back()};
}

}  // namespace overlook::measure
