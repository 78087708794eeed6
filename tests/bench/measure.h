// Timing a piece of work several times, and what the machine itself can do.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace overlook::bench {

struct Times {
    double min_ms = 0, median_ms = 0, max_ms = 0;
    double peak_memory_mb = 0;  // the most this process held at any time during the work, in 10^6 bytes
};

void forget_peak_memory();
double peak_memory_mb();

// Runs `work` once unmeasured, then `repeats` times.
template <class Work>
Times time_of(int repeats, const Work& work) {
    forget_peak_memory();
    work();
    std::vector<double> ms;
    for (int i = 0; i < repeats; ++i) {
        auto begin = std::chrono::steady_clock::now();
        work();
        ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    std::sort(ms.begin(), ms.end());
    return {ms.front(), ms[ms.size() / 2], ms.back(), peak_memory_mb()};
}

// Bytes a second that all threads together move through memory: the triad a[i] = b[i] + s * c[i] over arrays far larger than any
// cache, counted as three times eight bytes an element (McCalpin's STREAM). In 10^9 bytes a second.
double memory_bandwidth_gb_s();

// What the processor calls itself.
std::string machine_name();

}  // namespace overlook::bench
