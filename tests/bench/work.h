// What one iteration of a benchmark does, beside how long it takes.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>

namespace overlook::bench {

struct Work {
    double count = 0;  // of units
    const char* unit = "";
    double least_bytes = 0;        // what any way of doing it must read and write; 0 = it is no work on memory
    double bytes_per_sample = -1;  // of what it writes or reads; below 0: says nothing
};

// Measures `work`, whose result says what it did; once before unmeasured. The counters "work", "least_bytes", "bytes_per_sample",
// "peak_memory_mb" and "allocations" (per iteration) are what CsvReporter takes; the unit is the label.
void repeat(benchmark::State& state, const std::function<Work()>& work);

// Registers "NAME/INPUT", by the clock on the wall (several threads work), in milliseconds.
void add(const std::string& name, const std::string& input, const std::function<void(benchmark::State&)>& body);

}  // namespace overlook::bench
