// G, honesty: what a cut of a terrain promises of each triangle, against what it does.
#pragma once

#include <vector>

#include "runtime/terrain/predict.h"

namespace overlook::measure {

constexpr double kNotSeen = -1;

// For every triangle of a cut: the greatest distance on the screen, in pixels, between a source sample that it covers (at the
// same column and row; borders count) and the point that it draws there, over the samples of which one or the other is in the
// frame; kNotSeen if there is none, infinite if one of the two is behind the eye. Exact point-in-triangle arithmetic. O(samples
// covered).
void measure_triangles(const terrain::Terrain& terrain, const terrain::Cut& cut, const view::Camera& camera,
                       std::vector<float>& measured_px);

struct Honesty {
    uint64_t triangle_count = 0;  // seen
    uint64_t broken_count = 0;    // of them, measured above predicted
    uint64_t rated_count = 0;     // of them, predicted above 0
    double greatest_share = 0;    // measured / predicted, over those rated
    double median_share = 0;      // likewise
};

// Adds one cut's triangles to a tally and says what it comes to.
class HonestyTally {
  public:
    void add(const std::vector<float>& predicted_px, const std::vector<float>& measured_px);
    Honesty result() const;

  private:
    Honesty sums_;
    std::vector<float> shares_;
};

}  // namespace overlook::measure
