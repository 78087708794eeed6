// Void and cluster: ranks are given to places so that those of every prefix lie apart from each other, on a torus.
#include <algorithm>
#include <cmath>
#include <random>

#include "tools/bake/discrete/visibility.h"

namespace overlook::discrete {
namespace {

constexpr uint32_t kSide = 64, kCount = kSide * kSide;
constexpr double kSigma = 1.5;  // Ulichney's

// Who is marked, and how crowded every place is by those marked: the sum of a bell curve round each.
class Crowd {
  public:
    Crowd() : is_marked_(kCount, 0), crowding_(kCount, 0), bell_(kCount) {
        for (uint32_t i = 0; i < kCount; ++i) {
            double x = std::min(i % kSide, kSide - i % kSide), y = std::min(i / kSide, kSide - i / kSide);
            bell_[i] = std::exp(-(x * x + y * y) / (2 * kSigma * kSigma));
        }
    }
    void set(uint32_t at, bool is_marked) {
        is_marked_[at] = is_marked;
        uint32_t x = at % kSide, y = at / kSide;
        for (uint32_t i = 0; i < kCount; ++i)
            crowding_[i] +=
                (is_marked ? 1 : -1) * bell_[(i / kSide + kSide - y) % kSide * kSide + (i % kSide + kSide - x) % kSide];
    }
    bool is_marked(uint32_t at) const { return is_marked_[at] != 0; }
    // The marked place that is most crowded; the one without a mark that is least.
    uint32_t tightest_cluster() const {
        return best([&](uint32_t i) { return is_marked_[i] ? crowding_[i] : -1e300; });
    }
    uint32_t largest_void() const {
        return best([&](uint32_t i) { return is_marked_[i] ? -1e300 : -crowding_[i]; });
    }

  private:
    static uint32_t best(const auto& score) {
        uint32_t best = 0;
        for (uint32_t i = 1; i < kCount; ++i)
            if (score(i) > score(best)) best = i;
        return best;
    }
    std::vector<uint8_t> is_marked_;
    std::vector<double> crowding_, bell_;
};

// A tenth of the places, moved from clusters to voids until none gains by it.
Crowd first_crowd(uint64_t seed) {
    Crowd crowd;
    std::mt19937_64 random(seed);
    for (uint32_t marked = 0; marked < kCount / 10;) {
        auto at = uint32_t(random() % kCount);
        if (crowd.is_marked(at)) continue;
        crowd.set(at, true);
        ++marked;
    }
    for (uint32_t moves = 0; moves < kCount; ++moves) {
        uint32_t cluster = crowd.tightest_cluster();
        crowd.set(cluster, false);
        uint32_t space = crowd.largest_void();
        crowd.set(space, true);
        if (space == cluster) break;
    }
    return crowd;
}

}  // namespace

Visibility blue_noise(const VisibilityOptions& options) {
    Crowd crowd = first_crowd(options.seed);
    std::vector<uint32_t> rank(kCount);
    Crowd shrinking = crowd;
    for (uint32_t left = kCount / 10; left-- > 0;) {
        uint32_t cluster = shrinking.tightest_cluster();
        shrinking.set(cluster, false);
        rank[cluster] = left;
    }
    // Voids are where those without a mark crowd, whether they are few or many: one rule serves to the end.
    for (uint32_t next = kCount / 10; next < kCount; ++next) {
        uint32_t space = crowd.largest_void();
        crowd.set(space, true);
        rank[space] = next;
    }
    Visibility noise{Visibility::Lookup::paper, kSide, kSide, 1, float(options.period_m), std::vector<uint8_t>(kCount)};
    for (uint32_t i = 0; i < kCount; ++i) noise.values[i] = uint8_t(rank[i] * 256 / kCount);
    return noise;
}

}  // namespace overlook::discrete
