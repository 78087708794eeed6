// Which error to ask of chains of levels so that a frame keeps within a budget of triangles.
//
// Based on: T. Funkhouser, C. Sequin, Adaptive Display Algorithm for Interactive Frame Rates, 1993 (what a choice will cost is
// known before it is drawn). Different here: one error for all, the least that fits, found by halving, from the levels in use,
// whose hysteresis makes cost answer an error late.
#pragma once

#include <span>

#include "runtime/discrete/director.h"

namespace overlook::discrete {

class BudgetKeeper {
  public:
    // least_error_px > 0: never asks for less.
    BudgetKeeper(double triangles, double least_error_px)
        : triangles_(triangles), least_px_(least_error_px), error_px_(least_error_px) {}

    // From now on.
    void set_triangles(double triangles) { triangles_ = triangles; }
    // What to ask of the next frame, from this camera. Directors: of one picture, all asked alike but for their error. Rests
    // while that keeps between 95 and 100 % of the budget; else comes to 97.5 % of it. O(instances), some 20 times if it does not
    // rest.
    double error_px(std::span<const Director* const> directors, const view::Camera& camera);
    // What the frame asked for came to: FrameList::settled_triangle_count of all directors.
    void frame_done(double settled_triangles);

  private:
    double triangles_, least_px_, error_px_;
    double predicted_ = 0, correction_ = 1;  // of the last frame; how many times more frames take than is predicted of them
};

// Triangles that a frame takes from there when every instance has the level that it wants for this error, as from the one in use;
// what the camera will see a moment later, and what the picture's sides cut off, left out of account.
double predicted_triangles(const Director& director, const view::Camera& camera, double error_px);

}  // namespace overlook::discrete
