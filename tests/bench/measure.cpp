#include "tests/bench/measure.h"

#include <fstream>

#include "formats/parallel.h"

namespace overlook::bench {

double memory_bandwidth_gb_s() {
    constexpr size_t kElements = size_t(1) << 24, kGrain = size_t(1) << 18;
    std::vector<double> a(kElements), b(kElements), c(kElements);
    parallel_ranges(kElements, kGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) a[i] = 0, b[i] = double(i), c[i] = 1;
    });
    Times times = time_of(7, [&] {
        parallel_ranges(kElements, kGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) a[i] = b[i] + 3.0 * c[i];
        });
    });
    return 3.0 * sizeof(double) * double(kElements) / (times.min_ms * 1e6);
}

std::string machine_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "unknown processor";
}

void forget_peak_memory() {
    std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mb() {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) * 1024 / 1e6;
    return 0;
}

}  // namespace overlook::bench
