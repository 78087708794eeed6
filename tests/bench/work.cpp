#include "tests/bench/work.h"

#include "tests/allocations.h"
#include "tests/bench/machine.h"

namespace overlook::bench {

void repeat(benchmark::State& state, const std::function<Work()>& work) {
    forget_peak_memory();
    Work done = work();
    uint64_t allocations = 0, iterations = 0;
    for ([[maybe_unused]] auto iteration : state) {
        uint64_t before = test::allocation_count();
        done = work();
        allocations += test::allocation_count() - before;
        ++iterations;
        benchmark::ClobberMemory();
    }
    state.SetLabel(done.unit);
    state.counters["work"] = done.count;
    state.counters["least_bytes"] = done.least_bytes;
    state.counters["bytes_per_sample"] = done.bytes_per_sample;
    state.counters["peak_memory_mb"] = peak_memory_mb();
    state.counters["allocations"] = double(allocations) / double(iterations);
}

void add(const std::string& name, const std::string& input, const std::function<void(benchmark::State&)>& body) {
    benchmark::RegisterBenchmark((name + "/" + input).c_str(), body)->UseRealTime()->Unit(benchmark::kMillisecond);
}

}  // namespace overlook::bench
