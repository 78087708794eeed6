#include "tools/measure/numbers/memory_bandwidth.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <vector>

#include "formats/parallel.h"

namespace overlook::measure {

double memory_bandwidth_gb_s() {
    constexpr size_t kElements = size_t(1) << 24, kGrain = size_t(1) << 18;
    std::vector<double> a(kElements), b(kElements), c(kElements);
    parallel_ranges(kElements, kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) a[i] = 0, b[i] = double(i), c[i] = 1;
    });
    double least_s = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < 8; ++repeat) {
        auto begin = std::chrono::steady_clock::now();
        parallel_ranges(kElements, kGrain, [&](size_t first, size_t end) {
            for (size_t i = first; i < end; ++i) a[i] = b[i] + 3.0 * c[i];
        });
        least_s = std::min(least_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return 3.0 * sizeof(double) * double(kElements) / (least_s * 1e9);
}

}  // namespace overlook::measure
