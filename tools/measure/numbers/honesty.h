// G: does a method keep the error that it promises?
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace overlook::measure {

// What a frame promises of each thing that it draws (a triangle, a splat) and that is seen, and how far it is off: [things] each,
// pixels.
struct Promises {
    std::vector<float> predicted_px, measured_px;
};

struct Honesty {
    size_t count = 0;             // triangles (or splats)
    size_t above_prediction = 0;  // measured more than was predicted
    size_t broken_zeros = 0;      // of those: predicted 0
    size_t exact = 0;             // predicted 0 and measured 0; they have no ratio
    double ratio_max = 0;         // measured / predicted; infinity with a broken zero; 0 without a ratio
    double ratio_median = 0;      // over triangles predicted above 0
    double measured_max_px = 0, predicted_max_px = 0;
};

// predicted_px, measured_px: [triangles] each, at least 0; what is no number counts as above its prediction. Where 0 is
// predicted, up to noise_px measured (the rounding of the measuring itself) is 0. O(n).
Honesty honesty_of(std::span<const float> predicted_px, std::span<const float> measured_px, double noise_px = 1e-6);

// measured / predicted, predicted not 0; infinite where it is no number.
double honesty_ratio(double predicted_px, double measured_px);

// The gate of every method: never more than predicted, and the predictions not idle: median ratio at least kIdleRatio (if there
// is one).
constexpr double kIdleRatio = 0.3;
bool has_ratios(const Honesty& honesty);
bool is_honest(const Honesty& honesty);

}  // namespace overlook::measure
