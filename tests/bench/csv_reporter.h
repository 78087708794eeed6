// Benchmarks as CSV, the units in its header, with the machine's own limit beside them.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace overlook::bench {

struct Machine {
    std::string processor;
    unsigned cores = 1;
    double triad_gb_s = 0;  // memory_bandwidth_gb_s() of the same run
};

class CsvReporter : public benchmark::BenchmarkReporter {
  public:
    // note: takes a line for people for each benchmark.
    CsvReporter(Machine machine, std::function<void(const std::string&)> note);

    bool ReportContext(const Context&) override { return true; }
    // All repetitions of one benchmark.
    void ReportRuns(const std::vector<Run>& runs) override;

    const std::string& csv() const { return csv_; }
    // What the first benchmark that could not run said; empty if all ran.
    const std::string& failure() const { return failure_; }
    int count() const { return count_; }

  private:
    Machine machine_;
    std::function<void(const std::string&)> note_;
    std::string csv_, failure_;
    int count_ = 0;
};

}  // namespace overlook::bench
