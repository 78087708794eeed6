// The error at which a frame keeps a budget whose cost is counted before it is drawn.
//
// Based on: T. Funkhouser, C. Sequin, Adaptive Display Algorithm for Interactive Frame Rates, 1993 (what a choice will cost is
// known before it is drawn). Different here: one error for all there is, found by a bracketed secant from the frame before's on.
// A controller that goes by what frames have cost (ErrorController) learns the same from pictures that were too dear.
#pragma once

#include <functional>

namespace overlook::view {

class CountedError {
  public:
    // Shares of a budget: what costs more than the first need not cost more still; what is looked for costs more than the second.
    static constexpr double kRestFrom = 0.95, kAimFrom = 0.96;

    // Of a frame, from now on, in any one unit; 0: any cost.
    void set_most(double most) {
        if (most != most_) bump_cost_ = -1;
        most_ = most;
    }
    double most() const { return most_; }

    // What to ask of the next frame: least_error_px > 0, or the error above it, up to 256 px, at which it costs 96 to 99 % of the
    // budget; where cost jumps over that, the next error that costs no more than all of it, or one up to 8 % below that costs 95
    // % at least if none between costs more than 105. Rests while the last answer costs between 95 and 100 %. If the greatest
    // error costs more, that. count: what the frame costs at an error, falling with it but for small ups; it is last asked for
    // what is returned.
    double error_px(double least_error_px, const std::function<double(double error_px)>& count);
    // How often the last of these counted: 1 at rest or without a budget or if that cannot be kept, 3 at rest beside a jump (17
    // at first beside one to less than 105 %); of errors from 0.001 px on 23 at most: two where it begins, steps that grow by
    // half from 0.01 of the logarithm on, 16 of which are more than all there is to 256 px, halvings up to 22 together, and the
    // answer once more.
    int count_count() const { return count_count_; }

    // Where many things of a frame come and go at once, so that it leaves more of the budget than kRestFrom over: at which error
    // between finest_px and error_px, at which it was counted, another part of it takes that up; error_px if at none, or if it
    // need not. As great as reaches kAimFrom, or the finest if that reaches kRestFrom at least. count: what all of it costs with
    // that part at an error, falling with it; it is last asked for what is returned, if at all.
    double filled_px(double finest_px, double error_px, double cost, const std::function<double(double error_px)>& count) const;

  private:
    struct Sample {
        double log_error = 0, cost = 0;
    };
    struct Bracket {
        Sample over, under;  // costs more than the aim's upper end, and no more
    };
    class Search;

    double most_ = 0, error_px_ = 0, bump_cost_ = -1;
    int count_count_ = 0;
};

}  // namespace overlook::view
