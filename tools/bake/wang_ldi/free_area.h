// Where one more disc has a place: an area cut into squares, those that one disc covers left out, the others halved on and on, so
// that darts hit what is free and a full area is known to be full.
//
// Based on: K. B. White, D. Cline, P. K. Egbert, Poisson Disk Point Sets by Hierarchical Dart Throwing, 2007.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/discs.h"

namespace overlook::wang_ldi {

class FreeArea {
  public:
    // A middle that is looked for lies in one of `rects` (which do not overlap) and has `radius` clear around it. Squares are
    // halved down to a side of `tolerance`: when draw() finds nothing, a radius larger by 1.5 * tolerance has a place nowhere.
    FreeArea(std::span<const Bounds> rects, double radius, double tolerance);

    struct Place {
        double x = 0, y = 0;
        double clearance = 0;  // radius or more
    };
    // A place at random, each part of what is free as likely as its area (White et al., section 3); none if there is none.
    // `discs` may have gained some since the last call, and lost none. Expected time is in the count of squares about discs.
    std::optional<Place> draw(const DiscGrid& discs, Random& random);

  private:
    void push(const Bounds& square, size_t level);
    Bounds take(Random& random, size_t& level);

    double radius_, tolerance_;
    std::vector<std::vector<Bounds>> squares_;  // [level], each of half the side
    std::vector<double> area_;                  // [level]
};

}  // namespace overlook::wang_ldi
