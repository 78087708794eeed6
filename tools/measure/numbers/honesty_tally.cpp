#include "tools/measure/numbers/honesty_tally.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overlook::measure {
namespace {

constexpr double kBinsADoubling = 4;
constexpr double kBinOfOnePixel = 40;  // the first bin reaches from 0 to 2^-9.75 px

}  // namespace

size_t HonestyTally::bin_of(double predicted_px) {
    double place = std::floor(kBinsADoubling * std::log2(predicted_px) + kBinOfOnePixel);
    return size_t(std::clamp(place, 0.0, double(kBins - 1)));
}

// The nearest rank, as of numbers/percentiles.h.
double HonestyTally::percentile_of(const Counts& counts, double share) {
    uint64_t rank = std::max<uint64_t>(1, uint64_t(std::ceil(share * double(counts.count)))), seen = 0;
    for (size_t step = 0; step < kRatioSteps; ++step) {
        seen += counts.ratios[step];
        if (seen >= rank) return double(step) / kRatioSteps;
    }
    return counts.worst_ratio;
}

void HonestyTally::sum_up(const Honesty& more) {
    all_.count += more.count;
    all_.above_prediction += more.above_prediction;
    all_.broken_zeros += more.broken_zeros;
    all_.exact += more.exact;
    all_.ratio_max = std::max(all_.ratio_max, more.ratio_max);
    all_.measured_max_px = std::max(all_.measured_max_px, more.measured_max_px);
    all_.predicted_max_px = std::max(all_.predicted_max_px, more.predicted_max_px);
    Counts whole;
    for (const Counts& bin : bins_) {
        whole.count += bin.count;
        whole.worst_ratio = std::max(whole.worst_ratio, bin.worst_ratio);
        for (size_t step = 0; step <= kRatioSteps; ++step) whole.ratios[step] += bin.ratios[step];
    }
    all_.ratio_median = whole.count == 0 ? 0 : percentile_of(whole, 0.5);
}

Honesty HonestyTally::add(std::span<const float> predicted_px, std::span<const float> measured_px) {
    Honesty these = honesty_of(predicted_px, measured_px);
    for (size_t i = 0; i < predicted_px.size(); ++i) {
        double predicted = predicted_px[i], measured = measured_px[i];
        if (predicted == 0) continue;
        double ratio = honesty_ratio(predicted, measured);
        Counts& bin = bins_[bin_of(std::isnan(predicted) ? 0 : std::max(predicted, 0.0))];
        ++bin.count;
        ++bin.ratios[ratio > 1 ? kRatioSteps : std::min(kRatioSteps - 1, uint32_t(ratio * kRatioSteps))];
        if (ratio <= bin.worst_ratio) continue;
        bin.worst_ratio = ratio;
        bin.worst_px = measured;
        bin.worst_promised_px = predicted;
    }
    sum_up(these);
    return these;
}

void HonestyTally::add(const HonestyTally& other) {
    for (size_t i = 0; i < kBins; ++i) {
        const Counts& from = other.bins_[i];
        Counts& to = bins_[i];
        to.count += from.count;
        for (size_t step = 0; step <= kRatioSteps; ++step) to.ratios[step] += from.ratios[step];
        if (from.worst_ratio <= to.worst_ratio) continue;
        to.worst_ratio = from.worst_ratio;
        to.worst_px = from.worst_px;
        to.worst_promised_px = from.worst_promised_px;
    }
    sum_up(other.all_);
}

std::vector<HonestyBin> HonestyTally::bins() const {
    std::vector<HonestyBin> filled;
    for (size_t i = 0; i < kBins; ++i) {
        const Counts& counts = bins_[i];
        if (counts.count == 0) continue;
        auto edge_px = [](size_t bin) { return std::exp2((double(bin) - kBinOfOnePixel) / kBinsADoubling); };
        double to_px = i + 1 == kBins ? std::numeric_limits<double>::infinity() : edge_px(i + 1);
        filled.push_back({i == 0 ? 0 : edge_px(i), to_px, counts.count, percentile_of(counts, 0.5), percentile_of(counts, 0.99),
                          counts.worst_px, counts.worst_promised_px});
    }
    return filled;
}

}  // namespace overlook::measure
