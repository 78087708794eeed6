#include "runtime/view/error_budget.h"

#include <algorithm>
#include <cmath>

namespace overlook::view {
namespace {

constexpr double kAim = 0.98, kRestFrom = 0.96;  // shares of the budget
constexpr double kMostFallAFrame = 0.03;         // of the error's logarithm
constexpr double kMostError_px = 256;
constexpr double kLeastExponent = 0.3, kMostExponent = 3;
constexpr double kLeastTimeShare = 0.85, kTimeAim = 0.925, kMostGrowth = 1.1;  // of a time
constexpr double kLeastLesson = 0.01;  // changes of the error below 1 % teach nothing about its effect

}  // namespace

void ErrorController::set_budget(const ErrorBudget& budget) {
    budget_ = budget;
    error_px_ = budget.cost > 0 ? std::max(error_px_, budget.least_error_px) : budget.least_error_px;
    latest_.forget();
}

double MiddleOfThree::next(double value) {
    latest_[size_t(count_ % 3)] = value;
    count_ = count_ < 5 ? count_ + 1 : 3;
    if (!is_full()) return value;
    std::array<double, 3> sorted = latest_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[1];
}

void ErrorController::learn(double cost) {
    if (last_cost_ > 0 && cost > 0) {
        double error_change = std::log(error_px_ / last_error_px_);
        if (std::abs(error_change) > kLeastLesson)
            exponent_ = std::clamp((exponent_ - std::log(cost / last_cost_) / error_change) / 2, kLeastExponent, kMostExponent);
    }
    last_cost_ = cost, last_error_px_ = error_px_;
}

void ErrorController::frame_done(double cost) {
    if (!(budget_.cost > 0)) return;
    if (budget_.is_measured) cost = latest_.next(cost);
    learn(cost);
    double share = cost / budget_.cost;
    if (share >= kRestFrom && share <= 1) return;
    double step = std::log(std::max(share, 1e-6) / kAim) / exponent_;
    error_px_ = std::clamp(error_px_ * std::exp(std::max(step, -kMostFallAFrame)), budget_.least_error_px,
                           std::max(kMostError_px, budget_.least_error_px));
    if (budget_.is_measured) latest_.forget();
}

void WorkAllowance::set_most_ms(double most_ms) {
    if (most_ms == most_ms_) return;
    most_ms_ = most_ms;
    latest_.forget(), settled_.forget();
    if (most_ms_ <= 0) work_ = 0;
}

// What a frame will take when changes are over lies between its time and that by how much work will be left of it: something of a
// time may be of no work.
void WorkAllowance::frame_done(double ms, double drawn, double settled, bool is_held_back) {
    if (most_ms_ <= 0) return;
    double settled_ms = settled_.next(drawn > 0 ? ms * settled / drawn : ms);
    ms = latest_.next(ms);
    if (!latest_.is_full()) return;
    double least_ms = std::min(ms, settled_ms), most_ms = std::max(ms, settled_ms);
    bool is_over = least_ms > most_ms_;
    if (!is_over && (most_ms >= kLeastTimeShare * most_ms_ || !is_held_back)) return;
    double aim = kTimeAim * most_ms_ / std::max(is_over ? least_ms : most_ms, 1e-6);
    work_ = is_over ? std::max(settled * aim, 1.0) : std::max(work_, settled) * std::min(aim, kMostGrowth);
    latest_.forget(), settled_.forget();
}

}  // namespace overlook::view
