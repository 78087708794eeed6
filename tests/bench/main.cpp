// Overlook's hot functions on this machine, as CSV, with the machine's own limit measured in the same run. Google Benchmark's own
// options (--benchmark_filter, --benchmark_min_time, ...) are taken as well.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "formats/atomic_file.h"
#include "runtime/command/command.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/csv_reporter.h"
#include "tests/bench/inputs.h"
#include "tests/bench/machine.h"
#include "tools/measure/numbers/memory_bandwidth.h"

using namespace overlook;

namespace {

struct Args {
    std::string out;
    int repeats = 5;
    bool small = false;
    bool prints_machine_kind = false;
};

// Picks from the command line what is Google Benchmark's.
std::vector<char*> taken_by_benchmark(int& argc, char** argv) {
    static char least_time[] = "--benchmark_min_time=0.1";  // one given by hand comes after it and wins
    std::vector<char*> words = {argv[0], least_time};
    char** end = std::stable_partition(argv + 1, argv + argc,
                                       [](const char* word) { return !std::string_view(word).starts_with("--benchmark_"); });
    words.insert(words.end(), end, argv + argc);
    argc = int(end - argv);
    return words;
}

void add_all(const Args& args) {
    for (const std::string& name : bench::landscape_names(args.small)) {
        bench::add_bake(name);
        bench::add_files(name, args.out);
        bench::add_refinement(name);
    }
    bench::add_view();
    bench::add_bake_mesh(args.small ? 32 : 160);
    bench::add_caveclod(args.small ? 32 : 160);
    bench::add_wang(args.small ? 300 : 10000);
    bench::add_warp(args.small);
    for (uint32_t side_px : args.small ? std::vector<uint32_t>{64} : std::vector<uint32_t>{512, 1024})
        bench::add_numbers(side_px);
}

int measure_all(const Args& args, const command::Common& common) {
    std::string processor = bench::processor_name(), kind = bench::machine_kind(processor, bench::core_count());
    if (args.prints_machine_kind) {
        std::puts(kind.c_str());
        return int(Exit::done);
    }
    std::error_code problem;
    std::filesystem::create_directories(args.out, problem);
    add_all(args);
    bench::CsvReporter reporter({processor, bench::core_count(), measure::memory_bandwidth_gb_s()},
                                [&](const std::string& line) { command::note(common, line); });
    benchmark::RunSpecifiedBenchmarks(&reporter);
    if (!reporter.failure().empty()) return command::fail("bench", {Exit::our_bug, reporter.failure()});
    if (reporter.count() == 0)
        return command::fail("bench", {Exit::bad_command, "--benchmark_filter: no benchmark has such a name"});
    std::string path = args.out + "/" + kind + ".csv";
    if (auto written = write_file(path, std::string_view(reporter.csv())); !written)
        return command::fail("bench", written.error());
    return int(Exit::done);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<char*> words = taken_by_benchmark(argc, argv);
    CLI::App app("Measures Overlook's hot functions on this machine.", "bench");
    Args args;
    command::Common common;
    app.add_option("--out", args.out, "Folder of the CSV file, which is named by the kind of machine");
    app.add_option("--repeats", args.repeats, "How often each is measured")->check(CLI::Range(1, 1000))->capture_default_str();
    app.add_flag("--small", args.small, "Small inputs: to try the benchmarks, not the machine");
    app.add_flag("--print-machine-kind", args.prints_machine_kind, "Say how files of results are named here");
    command::add_common(app, common);
    return command::run(app, common, argc, argv, [&] {
        if (args.out.empty() && !args.prints_machine_kind)
            return command::fail("bench", {Exit::bad_command, "--out is required"});
        std::string repeats = "--benchmark_repetitions=" + std::to_string(args.repeats);
        words.insert(words.begin() + 2, repeats.data());
        int count = int(words.size());
        benchmark::Initialize(&count, words.data());
        return measure_all(args, common);
    });
}
