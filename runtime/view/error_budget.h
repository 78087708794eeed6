// Keeps a frame's cost within a budget by moving the pixel error that is asked of it: fast up, slowly down, with a band in which
// it rests.
#pragma once

#include <array>

namespace overlook::view {

struct ErrorBudget {
    double cost = 0;            // of a frame, in any one unit (triangles, milliseconds); 0 = no budget
    double least_error_px = 1;  // never asks for less than this, however cheap the frames
    bool is_measured = false;   // the costs are times: one frame that is dear by chance moves nothing
};

// Cost falls as a power of the error, cost ~ error^-p. Over budget the error goes up at once, to where p, learned from the frames
// before, puts the cost at 97.5 % of the budget; under 95 % it comes down by at most 3 % a frame; between, it rests.
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
    double judged_cost(double cost);
    void learn(double cost);

    ErrorBudget budget_;
    double error_px_;
    double exponent_ = 1;                       // p
    double last_cost_ = 0, last_error_px_ = 0;  // of the frame before; 0 = none
    std::array<double, 3> latest_{};            // measured costs
    int latest_count_ = 0;
};

}  // namespace overlook::view
