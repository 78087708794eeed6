// G over many frames, without keeping the frames' triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/measure/numbers/honesty.h"

namespace overlook::measure {

// Things that were promised about as much, and how far they were off.
struct HonestyBin {
    double from_px = 0, to_px = 0;               // promised at least, and less than; the last one's end is infinite
    uint64_t count = 0;                          // > 0
    double ratio_median = 0, ratio_p99 = 0;      // measured / predicted
    double worst_px = 0, worst_promised_px = 0;  // measured and predicted of the thing with the greatest ratio
};

// Sums up what honesty_of says of one frame after the other. Keeps a fixed number of counts, whatever is added.
class HonestyTally {
  public:
    // As honesty_of, of which it returns what it says of these alone.
    Honesty add(std::span<const float> predicted_px, std::span<const float> measured_px);
    void add(const HonestyTally& other);

    // Of all that was added. ratio_median is rounded down, by at most 1/1024 where it is under 1; all else is exact.
    const Honesty& all() const { return all_; }
    // By what was predicted, ascending, four to the doubling; without the empty ones and what was predicted 0. Their ratios are
    // rounded down as above.
    std::vector<HonestyBin> bins() const;

  private:
    static constexpr uint32_t kRatioSteps = 1024, kBins = 80;
    struct Counts {
        uint64_t count = 0;
        std::array<uint64_t, kRatioSteps + 1> ratios{};  // the last: above 1
        double worst_ratio = -1, worst_px = 0, worst_promised_px = 0;
    };
    static size_t bin_of(double predicted_px);
    static double percentile_of(const Counts& counts, double share);
    void sum_up(const Honesty& more);

    Honesty all_;
    std::vector<Counts> bins_ = std::vector<Counts>(kBins);
};

}  // namespace overlook::measure
