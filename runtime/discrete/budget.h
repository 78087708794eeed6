// How much coarser than asked the levels of chains must be so that a frame keeps within a budget of triangles.
//
// Based on: T. Funkhouser, C. Sequin, Adaptive Display Algorithm for Interactive Frame Rates, 1993 (what a choice will cost is
// known before it is drawn). Different here: all are coarser alike, by the least that fits, found by halving; from the levels in
// use, whose hysteresis makes cost answer late. A controller that goes by what frames have cost (view::ErrorController) would go
// on while nothing answers, and then too far.
#pragma once

#include <span>

#include "runtime/discrete/demand.h"

namespace overlook::discrete {

class BudgetKeeper {
  public:
    // Of a frame, from now on; 0: as many as what is asked takes.
    void set_triangles(double triangles);
    double triangles() const { return triangles_; }

    // How many times as coarse as asked levels are to be in the next frame, 1 to 4096. demands: of all directors of the picture.
    // Rests while that keeps between 95 and 100 % of the budget, or under it at what was asked; else comes to the least that
    // takes 97.5 % of it at most, where even the fewest triangles are more, those, and rests while nothing less coarse takes as
    // few. What is taken beside, while levels change, is not in it.
    double times(std::span<const Demand> demands);
    // How often the last of these summed up what its demands take: 1 at rest, 3 where the budget cannot be kept, 24 at most.
    int sum_count() const { return sum_count_; }

  private:
    double triangles_ = 0, times_ = 1;
    int sum_count_ = 0;
};

}  // namespace overlook::discrete
