#include "runtime/lod_sprite/key.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overlook::lod_sprite {

view::Camera key_camera(const view::Camera& frame, double guard) {
    constexpr double kWidestFov_deg = 170;
    double focal_px = view::focal_px(frame);
    double most_px = std::floor(2 * focal_px * std::tan(kWidestFov_deg / 2 * std::numbers::pi / 180));
    auto guarded = [&](uint32_t side_px) { return std::max(double(side_px), std::min(std::ceil(guard * side_px), most_px)); };
    view::Camera key = frame;
    key.width_px = uint32_t(guarded(frame.width_px));
    key.height_px = uint32_t(guarded(frame.height_px));
    key.fov_y_deg = 2 * std::atan(key.height_px / (2 * focal_px)) * 180 / std::numbers::pi;
    return key;
}

Link link_of(const view::Camera& key, const view::Camera& novel) {
    view::Axes axes = view::axes_of(key);
    Link link;
    link.key_from_world = glm::transpose(glm::dmat3(axes.right, axes.up, axes.forward));
    link.eye_m = link.key_from_world * (novel.position_m - key.position_m);
    double focal_px = view::focal_px(key);
    link.tangents = {key.width_px / (2 * focal_px), key.height_px / (2 * focal_px)};
    return link;
}

}  // namespace overlook::lod_sprite
