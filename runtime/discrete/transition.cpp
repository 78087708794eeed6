#include "runtime/discrete/transition.h"

#include <algorithm>

namespace overlook::discrete {
namespace {

constexpr double kRounding = 1e-9;  // of sums of steps that make up fade_s

uint32_t apart(uint32_t a, uint32_t b) {
    return a > b ? a - b : b - a;
}

}  // namespace

double visible_share_of_new(double phase) {
    return std::clamp(2 * phase, 0.0, 1.0);
}

double visible_share_of_old(double phase) {
    return std::clamp(2 - 2 * phase, 0.0, 1.0);
}

double visible_share(const Transition& transition, uint32_t level) {
    if (transition.is_resting()) return level == transition.to ? 1 : 0;
    if (level == transition.to) return visible_share_of_new(transition.phase);
    return level == transition.from ? visible_share_of_old(transition.phase) : 0;
}

double eased(double phase) {
    constexpr double kSettingOff = 1.0 / 8, kPace = 1 / (1 - kSettingOff);
    double from_end = std::clamp(std::min(phase, 1 - phase), 0.0, 0.5);
    double share =
        from_end < kSettingOff ? kPace * from_end * from_end / (2 * kSettingOff) : kPace * (from_end - kSettingOff / 2);
    return phase < 0.5 ? share : 1 - share;
}

Transition step(const Transition& now, uint32_t wanted, double dt_s, double fade_s, bool is_one_by_one) {
    Transition next = now;
    if (next.is_resting()) {
        if (wanted == next.to) return next;
        next.to = !is_one_by_one ? wanted : wanted > next.from ? next.from + 1 : next.from - 1;
        next.phase = 0;
    } else if (apart(wanted, next.from) < apart(wanted, next.to)) {
        next = {now.to, now.from, 1 - now.phase};
    }
    next.phase += dt_s / fade_s;
    return next.phase < 1 - kRounding ? next : Transition{next.to, next.to, 0};
}

}  // namespace overlook::discrete
