// Where the time goes.
#pragma once

#include <chrono>

namespace overlook::caveclod {

// Adds the time that it lives to a sum.
class Stopwatch {
  public:
    explicit Stopwatch(double& sum_s) : sum_s_(sum_s), begin_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() { sum_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& sum_s_;
    std::chrono::steady_clock::time_point begin_;
};

}  // namespace overlook::caveclod
