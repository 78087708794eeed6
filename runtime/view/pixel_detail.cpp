#include "runtime/view/pixel_detail.h"

#include <algorithm>

namespace overlook::view {

MaskOnScreen::MaskOnScreen(const Camera& camera, const PictureMask& mask)
    : mask_(mask),
      is_empty_(mask.is_empty()),
      near_m_(camera.near_m),
      share_per_tangent_x_(focal_px(camera) / camera.width_px),
      share_per_tangent_y_(focal_px(camera) / camera.height_px) {}

// It lies between these slopes to the camera's axis.
bool MaskOnScreen::is_touched(const Range& right, const Range& up, const Range& forward) const {
    double nearest = std::max(forward.low, near_m_), farthest = std::max(forward.high, near_m_);
    auto least = [&](double side) { return side / (side > 0 ? farthest : nearest); };
    auto greatest = [&](double side) { return side / (side > 0 ? nearest : farthest); };
    return mask_.is_touched(0.5 + share_per_tangent_x_ * least(right.low), 0.5 + share_per_tangent_x_ * greatest(right.high),
                            0.5 - share_per_tangent_y_ * greatest(up.high), 0.5 - share_per_tangent_y_ * least(up.low));
}

FinerParts::FinerParts(const Camera& camera, const PixelDetail& detail)
    : error_px_(detail.near_error_px), near_depth_m_(detail.near_depth_m), finer_in_(camera, detail.finer_in) {
    if (!detail.seen_by) return;
    Axes axes = axes_of(camera);
    glm::dvec3 away_m = detail.seen_by->position_m - camera.position_m;
    for (const glm::dvec3& inwards : sides_of(*detail.seen_by)) {
        sides_[side_count_++] = {{glm::dot(axes.right, inwards), glm::dot(axes.up, inwards), glm::dot(axes.forward, inwards)},
                                 glm::length(inwards),
                                 glm::dot(inwards, away_m)};
    }
}

bool FinerParts::touch(const SphereErrorBound::Place& middle, double radius_m) const {
    if (middle.forward - radius_m < near_depth_m_) return true;
    glm::dvec3 at_m(middle.right, middle.up, middle.forward);
    for (uint32_t i = 0; i < side_count_; ++i)
        if (glm::dot(sides_[i].inwards, at_m) - sides_[i].length * radius_m < sides_[i].offset_m) return true;
    auto round = [&](double at) { return Range{at - radius_m, at + radius_m}; };
    return !finer_in_.is_empty() && finer_in_.is_touched(round(middle.right), round(middle.up), round(middle.forward));
}

}  // namespace overlook::view
