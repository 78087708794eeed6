// Whether anything within a box can be on a picture, or all of it is, splats and rounding included.
#pragma once

#include <glm/glm.hpp>

#include "runtime/wang_ldi/brush.h"

namespace overlook::wang_ldi {

class PictureBounds {
  public:
    explicit PictureBounds(const view::Camera& camera) : eye_(camera) {}

    // wide: of the widest splat, times the focal length, in metres. What is not on the picture by this, no splat of it is: the
    // box is behind one of the picture's sides, a pixel and half a splat farther out, or nearer than anything is drawn.
    bool may_hold(const glm::dvec3& low_m, const glm::dvec3& high_m, double wide) const {
        constexpr float kMargin_px = 2;  // a splat's width is rounded, and so is where it begins
        glm::vec2 half_px = eye_.middle_px + kMargin_px;
        auto half_wide = float(wide / 2);
        bool is_left = true, is_right = true, is_above = true, is_below = true, is_near = true;
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 at(corner & 1 ? high_m.x : low_m.x, corner & 2 ? high_m.y : low_m.y, corner & 4 ? high_m.z : low_m.z);
            glm::vec3 seen = eye_.seen(at - eye_.position_m);
            glm::vec2 side = half_px * seen.z + half_wide;
            is_left &= seen.x<-side.x, is_right &= seen.x> side.x;
            is_below &= seen.y<-side.y, is_above &= seen.y> side.y;
            is_near &= seen.z < 0.99f * eye_.near_m;
        }
        return !(is_left || is_right || is_above || is_below || is_near);
    }

    // Whether all splats of what is in the box lie in the picture: nothing of it needs to be asked for again.
    bool holds_all(const glm::dvec3& low_m, const glm::dvec3& high_m, double wide) const {
        constexpr float kMargin_px = 2;
        glm::vec2 half_px = eye_.middle_px - kMargin_px;
        for (int corner = 0; corner < 8; ++corner) {
            glm::dvec3 at(corner & 1 ? high_m.x : low_m.x, corner & 2 ? high_m.y : low_m.y, corner & 4 ? high_m.z : low_m.z);
            glm::vec3 seen = eye_.seen(at - eye_.position_m);
            glm::vec2 side = half_px * seen.z - float(wide / 2);
            if (std::abs(seen.x) > side.x || std::abs(seen.y) > side.y || seen.z < 1.01f * eye_.near_m) return false;
        }
        return true;
    }

  private:
    Eye eye_;
};

}  // namespace overlook::wang_ldi
