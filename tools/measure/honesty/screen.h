// Where places are in a camera's picture: what is promised in pixels is measured there.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <optional>

#include "runtime/view/camera.h"

namespace overlook::measure {

// Projects places of one camera.
class Screen {
  public:
    explicit Screen(const view::Camera& camera)
        : camera_(camera), axes_(view::axes_of(camera)), focal_px_(view::focal_px(camera)) {}

    // From the picture's middle, pixels; nothing before the near plane.
    std::optional<glm::dvec2> at(const glm::dvec3& place_m) const {
        glm::dvec3 from_eye = place_m - camera_.position_m;
        double depth_m = glm::dot(from_eye, axes_.forward);
        if (depth_m < camera_.near_m) return std::nullopt;
        return glm::dvec2(glm::dot(from_eye, axes_.right), glm::dot(from_eye, axes_.up)) * (focal_px_ / depth_m);
    }
    bool is_in_frame(const glm::dvec2& at_px) const {
        return std::abs(at_px.x) <= camera_.width_px / 2.0 && std::abs(at_px.y) <= camera_.height_px / 2.0;
    }

  private:
    view::Camera camera_;
    view::Axes axes_;
    double focal_px_;
};

}  // namespace overlook::measure
