// Where a camera will be when a change that begins now is over.
#pragma once

#include <deque>

#include "runtime/view/camera.h"

namespace overlook::discrete {

// Goes on as the camera did: by the slower of its last step and of its steps in window_s before that one, so that neither a
// camera that shakes nor one that was put elsewhere is thought to travel. Exact of one that has moved and turned evenly for
// window_s and two frames.
class Foresight {
  public:
    // One frame: the camera now, dt_s >= 0 since the last one. Returns it as it will be in horizon_s; itself where that is not
    // known yet. window_s > 0.
    view::Camera ahead(const view::Camera& now, double dt_s, double window_s, double horizon_s);

  private:
    // What a camera did, a second.
    struct Motion {
        glm::dvec3 move_m{0};
        double heading_deg = 0, pitch_deg = 0;
    };
    struct Step {
        Motion motion;  // of all of the step
        double dt_s = 0;
    };
    static Motion between(const view::Camera& before, const view::Camera& now);
    Motion mean_before() const;

    std::deque<Step> steps_;  // before the last one, window_s of them
    double known_s_ = 0;      // how long they took
    view::Camera last_;
    bool has_last_ = false;
};

}  // namespace overlook::discrete
