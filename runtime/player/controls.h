// Flying by hand: what keys and mouse do to the camera and to how it is drawn. Knows nothing of windows.
#pragma once

#include <optional>

#include "runtime/player/frame.h"
#include "runtime/view/camera.h"

namespace overlook::player {

// What the hands do in one frame.
struct Input {
    double forward = 0, right = 0, up = 0;  // -1, 0 or 1
    double turn_x_px = 0, turn_y_px = 0;    // mouse, right and down positive
    double wheel = 0;                       // notches, up positive: faster
    bool is_fast = false;
};

struct Flyer {
    double speed_factor = 1;  // 1/64..64, by the wheel
};

constexpr double kLeastHeight_m = 2;  // the eye above the ground

// What is flown over, as the hands feel it.
class Ground {
  public:
    virtual ~Ground() = default;
    // That the eye must not sink below at x, y; none where there is none.
    virtual std::optional<double> height_m(double x_m, double y_m) const = 0;
    // About how far a place is from it, from which the speed is taken.
    virtual double distance_m(const glm::dvec3& place_m) const = 0;
    virtual double step_m() const = 0;  // no longer ones are flown at once, so that no ridge is flown through
    virtual double least_speed_m_s() const = 0;
};

// Moves the camera by dt_s seconds: forward and right are level, up is up. The speed grows with the height above
// the ground, so that near things and far things pass equally fast. The eye never comes nearer to the ground than kLeastHeight_m,
// along the whole way and not only at its end.
void fly(view::Camera& camera, Flyer& flyer, const Input& input, double dt_s, const Ground& ground);

// The asked error after one press of + (coarser) or - (finer): a factor of 2^(1/2), from 1/16 to 256 pixels.
double changed_error_px(double error_px, int presses);

// Keys pressed in one frame that change how it is drawn.
struct Presses {
    int error = 0;                                            // +, less -
    int method = 0;                                           // M
    bool toggles_wireframe = false, toggles_sources = false;  // F, of what has_wireframe(); K, of what shows_sources()
};
void press(FrameStyle& style, const Presses& presses);

}  // namespace overlook::player
