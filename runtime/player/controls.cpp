#include "runtime/player/controls.h"

#include <algorithm>
#include <cmath>

namespace overlook::player {
namespace {

constexpr double kDegreesPerPixel = 0.12;
constexpr double kSteepest_deg = 89;
constexpr double kHeightsPerSecond = 0.8;  // at speed factor 1
constexpr double kFast = 4;
constexpr double kLongestFrame_s = 0.25;  // after a pause the camera does not leap
constexpr int kMostSteps = 256;

void keep_above_ground(glm::dvec3& position_m, const Ground& ground) {
    std::optional<double> height = ground.height_m(position_m.x, position_m.y);
    if (height) position_m.z = std::max(position_m.z, *height + kLeastHeight_m);
}

}  // namespace

void fly(view::Camera& camera, Flyer& flyer, const Input& input, double dt_s, const Ground& ground) {
    flyer.speed_factor = std::clamp(flyer.speed_factor * std::exp2(input.wheel / 4), 1.0 / 64, 64.0);
    camera.heading_deg = std::remainder(camera.heading_deg + kDegreesPerPixel * input.turn_x_px, 360.0);
    camera.pitch_deg = std::clamp(camera.pitch_deg - kDegreesPerPixel * input.turn_y_px, -kSteepest_deg, kSteepest_deg);

    double speed_m_s = std::max(ground.least_speed_m_s(), kHeightsPerSecond * ground.distance_m(camera.position_m));
    speed_m_s *= flyer.speed_factor * (input.is_fast ? kFast : 1);
    view::Axes axes = view::axes_of(camera);
    glm::dvec3 level_forward = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), axes.right));
    glm::dvec3 way_m = (input.forward * level_forward + input.right * axes.right + input.up * glm::dvec3(0, 0, 1)) * speed_m_s *
                       std::clamp(dt_s, 0.0, kLongestFrame_s);

    int steps = int(std::clamp(std::ceil(glm::length(way_m) / ground.step_m()), 1.0, double(kMostSteps)));
    for (int step = 0; step < steps; ++step) {
        camera.position_m += way_m / double(steps);
        keep_above_ground(camera.position_m, ground);
    }
}

double changed_error_px(double error_px, int presses) {
    return std::clamp(error_px * std::exp2(presses / 2.0), 1.0 / 16, 256.0);
}

void press(FrameStyle& style, const Presses& presses) {
    if (presses.error != 0) style.error_px = changed_error_px(style.error_px, presses.error);
    for (int i = 0; i < presses.method; ++i) style.method = next(style.method, style.thing);
    if (presses.toggles_wireframe && has_wireframe(style.method)) {
        bool is_shaded = style.look.look == terrain::Look::shaded;
        style.look.look = is_shaded ? terrain::Look::wireframe : terrain::Look::shaded;
    }
    if (presses.toggles_sources && shows_sources(style.method)) style.shows_sources = !style.shows_sources;
}

}  // namespace overlook::player
