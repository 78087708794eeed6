// How a camera sees lengths, and squares of pixels painted into a picture: what all that is warped ends with.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "runtime/view/camera.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

constexpr int kMostSplat_px = 64;  // of pixels of the picture, however fine it is warped

// A camera, asked for its axes once. finer: so many of its pixels lie along a side of one of the picture.
struct Eye {
    explicit Eye(const view::Camera& camera, uint32_t finer = 1)
        : position_m(camera.position_m),
          axes(view::axes_of(camera)),
          focal_px(view::focal_px(camera)),
          near_m(float(camera.near_m)),
          middle_px(glm::vec2(camera.width_px, camera.height_px) * 0.5f),
          most_splat_px(kMostSplat_px * int(finer)) {}

    // (right, up, forward) of a vector, right and up times the focal length: divided by forward they are pixels from the middle.
    glm::vec3 seen(const glm::dvec3& v) const {
        return {focal_px * glm::dot(axes.right, v), focal_px * glm::dot(axes.up, v), glm::dot(axes.forward, v)};
    }

    glm::dvec3 position_m;
    view::Axes axes;
    double focal_px;
    float near_m;
    glm::vec2 middle_px;
    int most_splat_px;
};

// A picture that is painted, by order or by depth. Of what is equally deep the colour of the lower number is shown, so that by
// depth the picture does not depend on the order.
template <Hiding hiding>
class PictureTarget {
  public:
    static constexpr bool kIsByDepth = hiding == Hiding::by_depth;
    explicit PictureTarget(Warped& picture) : picture_(&picture) {}
    int width_px() const { return int(picture_->width_px); }
    int height_px() const { return int(picture_->height_px); }

    void put(int x, int y, float depth_m, uint32_t colour) {
        size_t p = size_t(y) * picture_->width_px + size_t(x);
        if (hiding == Hiding::by_depth && is_hidden(p, depth_m, colour)) return;
        picture_->colours[p] = colour, picture_->depth_m[p] = depth_m;
    }

  private:
    bool is_hidden(size_t p, float depth_m, uint32_t colour) const {
        return depth_m > picture_->depth_m[p] || (depth_m == picture_->depth_m[p] && colour >= picture_->colours[p]);
    }
    Warped* picture_;
};

// Paints splats on a target, and counts.
template <class Target>
class Brush {
  public:
    static constexpr bool kIsByDepth = Target::kIsByDepth;  // the order does not matter
    Brush(const Eye& eye, const Target& target, WarpCounts& counts)
        : target_(target), counts_(counts), near_m_(eye.near_m), middle_px_(eye.middle_px), most_px_(eye.most_splat_px) {}

    // at: as Eye::seen, from the eye. wide: of the splat, times the focal length, in metres.
    void splat(const glm::vec3& at, float wide, uint32_t colour) {
        ++counts_.samples;
        if (!(at.z >= near_m_)) return;
        float nearness = 1 / at.z, x = middle_px_.x + at.x * nearness, y = middle_px_.y - at.y * nearness;
        int side = std::clamp(int(std::min(wide * nearness, 1e4f) + 0.5f), 1, most_px_);
        float half = 0.5f * float(side - 1);
        if (!(std::abs(x) < 1e6f && std::abs(y) < 1e6f)) return;
        fill(int(std::floor(x - half)), int(std::floor(y - half)), side, at.z, colour);
    }

  private:
    void fill(int left, int top, int side, float depth_m, uint32_t colour) {
        int right = std::min(left + side, target_.width_px()), bottom = std::min(top + side, target_.height_px());
        left = std::max(left, 0), top = std::max(top, 0);
        if (left >= right || top >= bottom) return;
        ++counts_.samples_drawn, counts_.pixels_written += uint64_t(right - left) * uint64_t(bottom - top);
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) target_.put(x, y, depth_m, colour);
    }

    Target target_;
    WarpCounts& counts_;
    float near_m_;
    glm::vec2 middle_px_;
    int most_px_;
};

}  // namespace overlook::wang_ldi
