// Keeps a frame's cost within a budget by what frames before it have cost: fast down, slowly up, with a band in which it rests.
// Moves the pixel error that is asked of it; or, for a time, the work that it may have, of methods that keep that by themselves.
#pragma once

#include <array>

namespace overlook::view {

struct ErrorBudget {
    double cost = 0;            // of a frame, in any one unit (triangles, milliseconds); 0 = no budget
    double least_error_px = 1;  // never asks for less than this, however cheap the frames
    bool is_measured = false;   // the costs are times: one frame that is dear by chance moves nothing
};

// Times scatter: the middle one of the last three.
class MiddleOfThree {
  public:
    // Counts from now on.
    void forget() { count_ = 0; }
    bool is_full() const { return count_ >= 3; }
    // The middle of the last three; if there are fewer, this one.
    double next(double value);

  private:
    std::array<double, 3> latest_{};
    int count_ = 0;
};

// Cost falls as a power of the error, cost ~ error^-p. Over budget the error goes up at once, to where p, learned from the frames
// before, puts the cost at 98 % of the budget; under 96 % it comes down by at most 3 % a frame; between, it rests.
class ErrorController {
  public:
    explicit ErrorController(const ErrorBudget& budget) : budget_(budget), error_px_(budget.least_error_px) {}

    // What to ask of the next frame.
    double error_px() const { return error_px_; }

    // What the last frame, drawn with error_px(), cost.
    void frame_done(double cost);

    // From now on; what was learned stays.
    void set_budget(const ErrorBudget& budget);

  private:
    void learn(double cost);

    ErrorBudget budget_;
    double error_px_;
    double exponent_ = 1;                       // p
    double last_cost_ = 0, last_error_px_ = 0;  // of the frame before; 0 = none
    MiddleOfThree latest_;                      // measured costs
};

// How much counted work (triangles) a frame may have so that it takes at most a time, whatever else takes time as well. Over it
// the work falls at once by as much as the time has to; under 85 % of it, if the allowance is what holds the work back, that
// grows by at most a tenth; each only after three frames.
class WorkAllowance {
  public:
    // most_ms: 0 = any time, and no allowance. From now on; the same as before changes nothing.
    void set_most_ms(double most_ms);
    // Of the next frame; 0: as much as it takes.
    double work() const { return work_; }
    // What the last frame took, the work drawn in it and what is left of that when changes under way are over. is_held_back: it
    // would have had more without the allowance.
    void frame_done(double ms, double drawn, double settled, bool is_held_back);

  private:
    double most_ms_ = 0, work_ = 0;
    MiddleOfThree latest_, settled_;  // milliseconds
};

}  // namespace overlook::view
