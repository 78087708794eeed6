#include "tools/measure/numbers/honesty.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "tools/measure/numbers/percentiles.h"

namespace overlook::measure {

// Infinite, too, where more than nothing was measured against a predicted nothing.
double honesty_ratio(double predicted_px, double measured_px) {
    double ratio = measured_px / predicted_px;
    return std::isnan(ratio) || predicted_px < 0 ? std::numeric_limits<double>::infinity() : ratio;
}

Honesty honesty_of(std::span<const float> predicted_px, std::span<const float> measured_px, double noise_px) {
    assert(predicted_px.size() == measured_px.size());
    Honesty honesty;
    honesty.count = predicted_px.size();
    std::vector<double> ratios;
    for (size_t i = 0; i < honesty.count; ++i) {
        double predicted = predicted_px[i], measured = measured_px[i];
        if (predicted > honesty.predicted_max_px) honesty.predicted_max_px = predicted;
        if (measured > honesty.measured_max_px) honesty.measured_max_px = measured;
        if (predicted == 0 && measured <= noise_px) {
            ++honesty.exact;
            continue;
        }
        double ratio = honesty_ratio(predicted, measured);
        honesty.broken_zeros += predicted == 0;
        honesty.above_prediction += ratio > 1;
        honesty.ratio_max = std::max(honesty.ratio_max, ratio);
        if (predicted != 0) ratios.push_back(ratio);
    }
    honesty.ratio_median = percentile(std::span<const double>(ratios), 0.5);
    return honesty;
}

bool has_ratios(const Honesty& honesty) {
    return honesty.exact + honesty.broken_zeros < honesty.count;
}

bool is_honest(const Honesty& honesty) {
    return honesty.above_prediction == 0 && (!has_ratios(honesty) || honesty.ratio_median >= kIdleRatio);
}

}  // namespace overlook::measure
