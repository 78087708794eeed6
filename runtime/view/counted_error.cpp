#include "runtime/view/counted_error.h"

#include <algorithm>
#include <cmath>

namespace overlook::view {
namespace {

constexpr double kAim = 0.975, kAimTo = 0.99;  // shares of the budget, as the class's
constexpr double kMostError_px = 256;
constexpr double kLess = 0.002, kNarrow = 0.0005;  // of the error's logarithm: a step down, and what a search leaves open
constexpr double kLeastStep = 0.01, kMostStep = 1;
constexpr double kFromEnds = 0.05;  // of a bracket, that its next place keeps from both ends
constexpr int kMostCounts = 22;
// Where the cost goes up by so little as the error grows, of the budget, it may have been within it before: so many steps are
// tried.
constexpr double kBump = 1.05, kBumpStep = 0.006;
constexpr int kBumpSteps = 14;
constexpr double kSameBump = 0.002;  // of the budget: beside one that costs as much none is looked for again

}  // namespace

// One search for one frame.
class CountedError::Search {
  public:
    // bump_cost: what the last answer beside a bump cost, before which nothing was found.
    Search(double most, double least_error_px, double bump_cost, const std::function<double(double)>& count)
        : most_(most),
          least_(std::log(least_error_px)),
          greatest_(std::max(least_, std::log(kMostError_px))),
          least_error_px_(least_error_px),
          bump_cost_(bump_cost),
          count_(count) {}

    double from(double error_px) {
        Sample here = at(std::clamp(std::log(std::max(error_px, least_error_px_)), least_, greatest_));
        bool is_under = here.cost <= most_, is_at_end = here.log_error == (is_under ? least_ : greatest_);
        if (is_at_end || (is_under && here.cost >= kRestFrom * most_)) return answer(here);
        if (is_under) {
            Sample finer = at(std::max(least_, here.log_error - kLess));
            if (finer.cost > most_) return answer(before_bump(here, finer));
            if (is_aim(finer) || finer.log_error == least_) return answer(finer);
            here = finer;
        }
        Bracket found = bracket(here);
        Sample best = narrowed(found);
        return answer(best.cost < kRestFrom * most_ ? before_bump(best, found.over) : best);
    }
    int count_count() const { return count_count_; }
    double bump_cost() const { return bump_cost_; }

  private:
    Sample at(double log_error) {
        ++count_count_;
        return last_ = {log_error, count_(error_px(log_error))};
    }
    // So that the least is asked for as it was said.
    double error_px(double log_error) const { return log_error <= least_ ? least_error_px_ : std::exp(log_error); }
    bool is_aim(const Sample& sample) const { return sample.cost >= kAimFrom * most_ && sample.cost <= kAimTo * most_; }
    bool is_over(const Sample& sample) const { return sample.cost > kAimTo * most_; }

    double answer(const Sample& sample) {
        if (last_.log_error != sample.log_error) at(sample.log_error);
        return error_px(sample.log_error);
    }

    // Steps up or down until the aim lies between two; both the same where an end comes first or one meets the aim.
    Bracket bracket(Sample here) {
        bool goes_up = is_over(here);
        double times = 1;
        while (true) {
            double step =
                std::clamp(std::abs(std::log(std::max(here.cost, 1e-6) / (kAim * most_))), kLeastStep, kMostStep) * times;
            Sample next = at(std::clamp(here.log_error + (goes_up ? step : -step), least_, greatest_));
            if (is_aim(next)) return {next, next};
            if (is_over(next) != goes_up) return goes_up ? Bracket{here, next} : Bracket{next, here};
            if (next.log_error <= least_ || next.log_error >= greatest_) return {next, next};
            here = next, times *= 1.5;
        }
    }

    // Leaves in `ends` what lies closest about it.
    Sample narrowed(Bracket& ends) {
        bool is_middle = false;
        while (ends.under.log_error - ends.over.log_error > kNarrow && count_count_ < kMostCounts) {
            double wide = ends.under.log_error - ends.over.log_error, over = std::log(ends.over.cost / (kAim * most_)),
                   under = std::log(std::max(ends.under.cost, 1e-6) / (kAim * most_));
            double share = is_middle ? 0.5 : std::clamp(over / (over - under), kFromEnds, 1 - kFromEnds);
            Sample next = at(ends.over.log_error + share * wide);
            if (is_aim(next)) return next;
            (is_over(next) ? ends.over : ends.under) = next;
            is_middle = !is_middle;  // secants alone may come from one side for ever
        }
        return ends.over.cost <= most_ ? ends.over : ends.under;
    }

    // Where a budget is kept by too much, beside an error a little less that costs too much: a lesser one that keeps it, if any.
    Sample before_bump(const Sample& here, const Sample& over) {
        if (here.cost > most_ || over.cost <= most_ || over.cost > kBump * most_) return here;
        if (std::abs(here.cost - bump_cost_) <= kSameBump * most_) return here;
        for (int step = 1; step <= kBumpSteps; ++step) {
            if (count_count_ >= kMostCounts) return here;
            Sample finer = at(std::max(least_, here.log_error - step * kBumpStep));
            if (finer.cost > kBump * most_) break;
            if (finer.cost <= most_ && finer.cost >= kRestFrom * most_) return finer;
            if (finer.log_error <= least_) break;
        }
        bump_cost_ = here.cost;
        return here;
    }

    double most_, least_, greatest_, least_error_px_, bump_cost_;
    const std::function<double(double)>& count_;
    Sample last_;
    int count_count_ = 0;
};

double CountedError::error_px(double least_error_px, const std::function<double(double)>& count) {
    if (!(most_ > 0)) {
        count(least_error_px);
        count_count_ = 1;
        return error_px_ = least_error_px;
    }
    Search search(most_, least_error_px, bump_cost_, count);
    error_px_ = search.from(error_px_), bump_cost_ = search.bump_cost();
    count_count_ = search.count_count();
    return error_px_;
}

double CountedError::filled_px(double finest_px, double error_px, double cost, const std::function<double(double)>& count) const {
    constexpr int kHalvings = 8;
    double least = kRestFrom * most_, aim = kAimFrom * most_;
    if (!(most_ > 0 && finest_px < error_px) || cost >= least) return error_px;
    double finest = count(finest_px);
    if (finest >= least && finest <= aim) return finest_px;
    if (finest > aim) {
        double fine_px = finest_px, coarse_px = error_px;
        for (int n = 0; n < kHalvings; ++n) {
            double middle_px = std::sqrt(fine_px * coarse_px);
            (count(middle_px) >= aim ? fine_px : coarse_px) = middle_px;
        }
        if (count(fine_px) <= most_) return fine_px;
    }
    count(error_px);
    return error_px;
}

}  // namespace overlook::view
