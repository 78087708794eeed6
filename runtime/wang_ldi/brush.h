// How a camera sees lengths, and squares of pixels painted into a picture: what all that is warped ends with.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "runtime/view/camera.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

constexpr int kMostSplat_px = 64;

// A camera, asked for its axes once.
struct Eye {
    explicit Eye(const view::Camera& camera)
        : position_m(camera.position_m),
          axes(view::axes_of(camera)),
          focal_px(view::focal_px(camera)),
          near_m(float(camera.near_m)),
          middle_px(glm::vec2(camera.width_px, camera.height_px) * 0.5f) {}

    // (right, up, forward) of a vector, right and up times the focal length: divided by forward they are pixels from the middle.
    glm::vec3 seen(const glm::dvec3& v) const {
        return {focal_px * glm::dot(axes.right, v), focal_px * glm::dot(axes.up, v), glm::dot(axes.forward, v)};
    }

    glm::dvec3 position_m;
    view::Axes axes;
    double focal_px;
    float near_m;
    glm::vec2 middle_px;
};

// Paints splats, and counts.
template <Hiding hiding>
class Brush {
  public:
    Brush(const Eye& eye, Warped& picture, WarpCounts& counts)
        : picture_(picture), counts_(counts), near_m_(eye.near_m), middle_px_(eye.middle_px) {}

    // at: as Eye::seen, from the eye. wide: of the splat, times the focal length, in metres.
    void splat(const glm::vec3& at, float wide, uint32_t colour) {
        ++counts_.samples;
        if (!(at.z >= near_m_)) return;
        float x = middle_px_.x + at.x / at.z, y = middle_px_.y - at.y / at.z;
        int side = std::clamp(int(std::min(wide / at.z, 1e4f) + 0.5f), 1, kMostSplat_px);
        float half = 0.5f * float(side - 1);
        if (!(std::abs(x) < 1e6f && std::abs(y) < 1e6f)) return;
        fill(int(std::floor(x - half)), int(std::floor(y - half)), side, at.z, colour);
    }

  private:
    void fill(int left, int top, int side, float depth_m, uint32_t colour) {
        int right = std::min(left + side, int(picture_.width_px)), bottom = std::min(top + side, int(picture_.height_px));
        left = std::max(left, 0), top = std::max(top, 0);
        if (left >= right || top >= bottom) return;
        ++counts_.samples_drawn, counts_.pixels_written += uint64_t(right - left) * uint64_t(bottom - top);
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) {
                size_t p = size_t(y) * picture_.width_px + size_t(x);
                if (hiding == Hiding::by_depth && !(depth_m < picture_.depth_m[p])) continue;
                picture_.colours[p] = colour, picture_.depth_m[p] = depth_m;
            }
    }

    Warped& picture_;
    WarpCounts& counts_;
    float near_m_;
    glm::vec2 middle_px_;
};

}  // namespace overlook::wang_ldi
