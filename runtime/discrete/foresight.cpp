#include "runtime/discrete/foresight.h"

#include <algorithm>
#include <cmath>

namespace overlook::discrete {
namespace {

constexpr double kRounding_s = 1e-9;

double slower(double a, double b) {
    return std::abs(a) < std::abs(b) ? a : b;
}

}  // namespace

Foresight::Motion Foresight::between(const view::Camera& before, const view::Camera& now) {
    double turn_deg = std::remainder(now.heading_deg - before.heading_deg, 360);
    return {now.position_m - before.position_m, turn_deg, now.pitch_deg - before.pitch_deg};
}

Foresight::Motion Foresight::mean_before() const {
    Motion sum;
    double all_s = 0;
    for (const Step& step : steps_) {
        sum.move_m += step.motion.move_m;
        sum.heading_deg += step.motion.heading_deg, sum.pitch_deg += step.motion.pitch_deg;
        all_s += step.dt_s;
    }
    return {sum.move_m / all_s, sum.heading_deg / all_s, sum.pitch_deg / all_s};
}

view::Camera Foresight::ahead(const view::Camera& now, double dt_s, double window_s, double horizon_s) {
    view::Camera ahead = now;
    if (has_last_ && dt_s > 0) {
        Step step{between(last_, now), dt_s};
        if (known_s_ >= window_s - kRounding_s) {
            Motion before = mean_before();
            glm::dvec3 move_m = step.motion.move_m / dt_s;
            if (glm::length(before.move_m) < glm::length(move_m)) move_m = before.move_m;
            ahead.position_m += horizon_s * move_m;
            ahead.heading_deg += horizon_s * slower(step.motion.heading_deg / dt_s, before.heading_deg);
            double pitch_deg = now.pitch_deg + horizon_s * slower(step.motion.pitch_deg / dt_s, before.pitch_deg);
            ahead.pitch_deg = std::clamp(pitch_deg, -90.0, 90.0);
        }
        steps_.push_back(step);
        known_s_ += dt_s;
        while (known_s_ - steps_.front().dt_s >= window_s) {
            known_s_ -= steps_.front().dt_s;
            steps_.pop_front();
        }
    }
    last_ = now;
    has_last_ = true;
    return ahead;
}

}  // namespace overlook::discrete
