// Points of a key in another camera's picture.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "runtime/lod_sprite/key.h"

namespace overlook::lod_sprite {

// Depths of neighbours in a key's grid farther apart than that are a step.
constexpr double kSteepest = 1.35;

class Projector {
  public:
    // Both must outlive it.
    Projector(const Key& key, const view::Camera& camera) : focal_px_(view::focal_px(camera)) {
        Link back = link_of(camera, key.camera);  // from the key into the camera
        Link own = link_of(key.camera, key.camera);
        turn_ = back.key_from_world * glm::transpose(own.key_from_world);
        eye_ = back.eye_m;
        tangents_ = own.tangents;
    }
    // Right, up and forward of the camera, metres; of what is infinitely far the direction. Shares: 0..1 over the key's picture,
    // from the top left.
    glm::dvec3 operator()(double share_x, double share_y, double depth_m) const {
        glm::dvec3 ray{(2 * share_x - 1) * tangents_.x, (1 - 2 * share_y) * tangents_.y, 1};
        return std::isfinite(depth_m) ? eye_ + turn_ * (ray * depth_m) : turn_ * ray;
    }
    // By how much a cell grows, besides by coming nearer, because it is seen farther from the axis: the secants' ratio (its area
    // goes with the inverse square of the distance and the cube of the secant). now_px: where it is seen, from the middle.
    double stretch(double share_x, double share_y, const glm::dvec2& now_px) const {
        auto secant = [](double x, double y) { return std::sqrt(1 + x * x + y * y); };
        return secant(now_px.x / focal_px_, now_px.y / focal_px_) /
               secant((2 * share_x - 1) * tangents_.x, (1 - 2 * share_y) * tangents_.y);
    }
    double focal_px() const { return focal_px_; }

  private:
    double focal_px_;
    glm::dmat3 turn_;
    glm::dvec3 eye_;
    glm::dvec2 tangents_;
};

}  // namespace overlook::lod_sprite
