#include "tests/bench/csv_reporter.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/parallel.h"

namespace overlook::bench {
namespace {

constexpr const char* kHeader =
    "benchmark,input,threads,repeats,min_ms,median_ms,max_ms,work_count,work_unit,work_per_ms,least_bytes_moved,moved_gb_per_s,"
    "machine_gb_per_s,share_of_machine_limit,bytes_per_sample,peak_memory_mb,allocations,cores,machine\n";

// A number, or nothing where there is none to say.
std::string cell(bool is_there, double number) {
    return is_there ? fmt::format("{:.6g}", number) : "";
}

}  // namespace

CsvReporter::CsvReporter(Machine machine, std::function<void(const std::string&)> note)
    : machine_(std::move(machine)), note_(std::move(note)), csv_(kHeader) {}

void CsvReporter::ReportRuns(const std::vector<Run>& runs) {
    std::vector<double> ms;
    const Run* last = nullptr;
    for (const Run& run : runs) {
        if (run.error_occurred && failure_.empty()) failure_ = run.benchmark_name() + ": " + run.error_message;
        if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
        ms.push_back(run.GetAdjustedRealTime());
        last = &run;
    }
    if (last == nullptr) return;
    std::sort(ms.begin(), ms.end());
    const std::string& name = last->run_name.function_name;
    std::string benchmark = name.substr(0, name.find('/')), input = name.substr(name.find('/') + 1);
    auto counter = [&](const char* of) { return last->counters.at(of).value; };

    double per_ms = counter("work") / ms.front(), least_bytes = counter("least_bytes"), gb_s = least_bytes / (ms.front() * 1e6);
    bool moves = least_bytes > 0, has_size = counter("bytes_per_sample") >= 0;
    csv_ += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{:.0f},{},{:.6g},{:.0f},{},{:.2f},{},{},{:.0f},{:.1f},{},\"{}\"\n",
                        benchmark, input, thread_count(), ms.size(), ms.front(), ms[ms.size() / 2], ms.back(), counter("work"),
                        last->report_label, per_ms, least_bytes, cell(moves, gb_s), machine_.triad_gb_s,
                        cell(moves, gb_s / machine_.triad_gb_s), cell(has_size, counter("bytes_per_sample")),
                        counter("peak_memory_mb"), counter("allocations"), machine_.cores, machine_.processor);
    ++count_;
    std::string line = fmt::format("{:<26} {:<26} {:>10.4g} ms {:>12.4g} M {}/s", benchmark, input, ms.front(), per_ms / 1000,
                                   last->report_label);
    if (moves) line += fmt::format(", {:.2g} % of the memory's limit", 100 * gb_s / machine_.triad_gb_s);
    note_(line);
}

}  // namespace overlook::bench
