#include "tools/bake/error_codes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "formats/parallel.h"
#include "formats/terrain.h"
#include "formats/terrain_check.h"

namespace overlook::terrain {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr size_t kCodes = 254;  // 1 .. 254
constexpr size_t kErrorsAtATime = 1 << 15;

struct Range {
    float low = kInfinite, high = 0;
};

class Scale {
  public:
    Scale(double step_m, double finest_error_m) : step_m_(step_m), finest_error_m_(finest_error_m) {}
    float metres(float in_steps) const { return float_at_least(finest_error_m_ + step_m_ * double(in_steps)); }

  private:
    double step_m_, finest_error_m_;
};

// Least and greatest error that is neither 0 nor infinite, in metres.
Range range_of_errors(const std::vector<std::vector<float>>& errors, const Scale& scale) {
    Range all;
    std::mutex guard;
    for (const std::vector<float>& level : errors)
        parallel_ranges(level.size(), kErrorsAtATime, [&](size_t begin, size_t end) {
            Range range;
            for (size_t i = begin; i < end; ++i) {
                if (level[i] == 0 || level[i] == kInfinite) continue;
                range.low = std::min(range.low, level[i]), range.high = std::max(range.high, level[i]);
            }
            std::lock_guard lock(guard);
            all.low = std::min(all.low, range.low), all.high = std::max(all.high, range.high);
        });
    if (all.high == 0) return {};
    return {scale.metres(all.low), scale.metres(all.high)};
}

// 1, 2 and 5 times the powers of ten strictly between low and high, with both ends.
std::vector<double> landmarks(double low, double high) {
    std::vector<double> marks{low};
    for (int power = int(std::floor(std::log10(low))); power <= int(std::ceil(std::log10(high))); ++power)
        for (double digit : {1.0, 2.0, 5.0}) {
            double mark = digit * std::pow(10.0, power);
            if (mark > low && mark < high) marks.push_back(mark);
        }
    marks.push_back(high);
    return marks;
}

size_t borders_between(double low, double high, double ratio) {
    return std::max<size_t>(1, size_t(std::ceil(std::log(high / low) / std::log(ratio))));
}

// Upper borders of at most kCodes bins that cover [low, high], increasing.
std::vector<float> borders(Range range) {
    if (range.low >= range.high) return {range.high};
    std::vector<double> marks = landmarks(range.low, range.high);
    auto count_at = [&](double ratio) {
        size_t count = 1;  // the least error has a bin of its own
        for (size_t i = 1; i < marks.size(); ++i) count += borders_between(marks[i - 1], marks[i], ratio);
        return count;
    };
    double ratio = 1.0001;
    while (count_at(ratio) > kCodes) ratio = 1 + (ratio - 1) * 1.01;

    std::vector<float> upper{range.low};
    for (size_t i = 1; i < marks.size(); ++i) {
        size_t count = borders_between(marks[i - 1], marks[i], ratio);
        for (size_t k = 1; k < count; ++k)
            upper.push_back(float(marks[i - 1] * std::pow(marks[i] / marks[i - 1], double(k) / double(count))));
        upper.push_back(float(marks[i]));
    }
    upper.back() = range.high;
    return upper;
}

// The first bin whose border is not below the error.
size_t bin_of(const std::vector<float>& upper, float error_m) {
    return std::min(size_t(std::lower_bound(upper.begin(), upper.end(), error_m) - upper.begin()), upper.size() - 1);
}

}  // namespace

ErrorCodes encode_errors(const std::vector<std::vector<float>>& errors, double step_m, double finest_error_m) {
    Scale scale(step_m, finest_error_m);
    std::vector<float> upper = borders(range_of_errors(errors, scale));
    std::vector<float> greatest(upper.size(), 0);
    std::mutex guard;

    ErrorCodes out;
    for (const std::vector<float>& level : errors) {
        std::vector<uint8_t>& codes = out.codes.emplace_back(level.size());
        parallel_ranges(level.size(), kErrorsAtATime, [&](size_t begin, size_t end) {
            std::vector<float> greatest_here(upper.size(), 0);
            for (size_t i = begin; i < end; ++i) {
                if (level[i] == 0) continue;  // code 0
                if (level[i] == kInfinite) {
                    codes[i] = kMustSplit;
                    continue;
                }
                float error_m = scale.metres(level[i]);
                size_t bin = bin_of(upper, error_m);
                codes[i] = uint8_t(bin + 1);
                greatest_here[bin] = std::max(greatest_here[bin], error_m);
            }
            std::lock_guard lock(guard);
            for (size_t bin = 0; bin < upper.size(); ++bin) greatest[bin] = std::max(greatest[bin], greatest_here[bin]);
        });
    }
    out.error_m[0] = float_at_least(finest_error_m);
    for (size_t code = 1; code <= kCodes; ++code) {
        float own = code <= greatest.size() ? greatest[code - 1] : 0;
        out.error_m[code] = std::max(out.error_m[code - 1], own);
    }
    out.error_m[kMustSplit] = kInfinite;
    return out;
}

}  // namespace overlook::terrain
