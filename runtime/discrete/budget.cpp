#include "runtime/discrete/budget.h"

#include <algorithm>
#include <cmath>

namespace overlook::discrete {
namespace {

constexpr double kRestFrom = 0.95, kAim = 0.975;  // shares of the budget
constexpr double kMostTimes = 4096;
constexpr double kLess = 0.999;  // by more than halvings leave open
constexpr int kHalvings = 20;

}  // namespace

void BudgetKeeper::set_triangles(double triangles) {
    triangles_ = triangles;
    if (triangles_ <= 0) times_ = 1;
}

double BudgetKeeper::times(std::span<const Demand> demands) {
    sum_count_ = 0;
    if (triangles_ <= 0) return times_;
    auto at = [&](double times) {
        ++sum_count_;
        double sum = 0;
        for (const Demand& demand : demands) sum += demand.triangles(times);
        return sum;
    };
    double here = at(times_);
    if (here <= triangles_ && (here >= kRestFrom * triangles_ || times_ == 1)) return times_;
    double fewest = at(kMostTimes);
    if (here > triangles_ && here <= fewest && (times_ == 1 || at(kLess * times_) > fewest)) return times_;
    double aim = std::max(kAim * triangles_, fewest);
    double low = 0, high = std::log(kMostTimes);
    if (at(1) <= aim) high = 0;
    for (int i = 0; i < kHalvings && low < high; ++i) {
        double middle = (low + high) / 2;
        (at(std::exp(middle)) <= aim ? high : low) = middle;
    }
    return times_ = std::exp(high);
}

}  // namespace overlook::discrete
