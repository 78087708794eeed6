// How much is unseen of what eyes meet, estimated from what they have met: squares or cubes that one eye alone has met.
//
// Based on: I. J. Good, The Population Frequencies of Species and the Estimation of Population Parameters, 1953 (A. Turing's
// estimate). Different: draws are eyes, for the rays of one eye meet the same cubes over and over.
#pragma once

#include <cstdint>

namespace overlook::wang_ldi {

class HeldOut {
  public:
    // Of one cube: how many hits it had, and by whom the first.
    struct Met {
        uint64_t eye = 0;
        uint32_t count = 0;
        bool is_of_one_eye = true;
    };

    // Eyes come one after the other: none twice.
    void meet(Met& met, uint64_t eye) {
        if (met.count == 0) met.eye = eye;
        ++hits_;
        if (met.is_of_one_eye && met.eye == eye) ++of_one_eye_;
        if (met.is_of_one_eye && met.eye != eye) met.is_of_one_eye = false, of_one_eye_ -= met.count;
        ++met.count;
    }
    // Of what is met and nowhere kept: unseen.
    void lose() { ++hits_, ++of_one_eye_; }
    uint64_t hits() const { return hits_; }
    // Each eye is held out in turn: of all hits, those in cubes that no other eye has met, or lost. 0 if nothing was met.
    double unseen_share() const { return hits_ == 0 ? 0 : double(of_one_eye_) / double(hits_); }
    // The share is no more than `goal`, of hits enough to believe it.
    bool is_within(double goal) const { return double(hits_) >= kLeastHits / goal && unseen_share() <= goal; }
    // What no eye of so many meets is never met.
    bool is_of_nothing(uint64_t eyes, uint64_t least_eyes) const { return hits_ == 0 && eyes >= kEyesOfNothing * least_eyes; }

  private:
    // Over the goal: of so many hits some would be in cubes of one eye, were the goal's share unseen, but for 2 % of the cases
    // (e^-4).
    static constexpr double kLeastHits = 4;
    static constexpr uint64_t kEyesOfNothing = 4;  // times the least

    uint64_t hits_ = 0, of_one_eye_ = 0;
};

}  // namespace overlook::wang_ldi
