// How uncertain the mean colours of texels are, from how the eyes that see each of them differ.
//
// Based on: W. G. Cochran, Sampling Techniques, 1977, sections 2.11 and 9A (a mean over clusters is a ratio, and varies as the
// clusters do, not as what is within each: an eye's rays see the same leaves).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace overlook::wang_ldi {

class TexelErrors {
  public:
    explicit TexelErrors(size_t texels) : texels_(texels) {}

    // Eyes come one after the other: none twice.
    void add(size_t texel, uint64_t eye, double luma) {
        Texel& one = texels_[texel];
        if (one.eyes == 0 || one.eye != eye) one.end_eye(), one.eye = eye, ++one.eyes;
        one.luma += luma, ++one.hits;
    }

    // Of the texels' mean lumas the standard error, root mean square over hits; 0 if there is none, infinite where no texel was
    // seen by two eyes. A texel that one eye alone saw is taken to be as uncertain, for its hits, as the others are together.
    double standard_error() const {
        double of_known = 0, known = 0, all = 0;
        for (const Texel& texel : texels_) {
            double hits = texel.all_hits();
            all += hits;
            if (texel.eyes > 1) of_known += hits * texel.variance_of_mean(), known += hits;
        }
        if (all == 0) return 0;
        return known == 0 ? INFINITY : std::sqrt(of_known / known);
    }
    // Sum over all hits.
    double luma() const {
        double sum = 0;
        for (const Texel& texel : texels_) sum += texel.all_luma();
        return sum;
    }

  private:
    // Of the eyes before the last one: sums over eyes of their hits and luma, and of the products of these.
    struct Texel {
        uint64_t eye = 0, eyes = 0;
        double hits = 0, luma = 0;  // of the last one
        double hits_sum = 0, luma_sum = 0, hits_hits = 0, hits_luma = 0, luma_luma = 0;

        void end_eye() {
            hits_sum += hits, luma_sum += luma;
            hits_hits += hits * hits, hits_luma += hits * luma, luma_luma += luma * luma;
            hits = luma = 0;
        }
        double all_hits() const { return hits_sum + hits; }
        double all_luma() const { return luma_sum + luma; }
        // Of luma over hits: squares of what each eye's luma is off the mean of its hits.
        double variance_of_mean() const {
            Texel whole = *this;
            whole.end_eye();
            double mean = whole.luma_sum / whole.hits_sum, count = double(eyes);
            double squares = whole.luma_luma - 2 * mean * whole.hits_luma + mean * mean * whole.hits_hits;
            return std::max(0.0, squares) * count / (count - 1) / (whole.hits_sum * whole.hits_sum);
        }
    };
    std::vector<Texel> texels_;
};

}  // namespace overlook::wang_ldi
