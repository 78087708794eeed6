#include "tools/measure/numbers/parallax.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace overlook::measure {

std::vector<float> parallax_px(const Frame& frame, const view::Camera& key) {
    view::Axes axes = view::axes_of(frame.camera);
    double focal_px = view::focal_px(frame.camera);
    glm::dvec3 moved_m = frame.camera.position_m - key.position_m;
    glm::dvec3 moved{glm::dot(moved_m, axes.right), glm::dot(moved_m, axes.up), glm::dot(moved_m, axes.forward)};
    auto parallax_of = [&](size_t i) {
        double depth_m = double(frame.depth_m[i]);
        if (!std::isfinite(depth_m)) return std::numeric_limits<double>::quiet_NaN();
        double right = (double(i % frame.width) + 0.5 - frame.width / 2.0) / focal_px;
        double up = (frame.height / 2.0 - double(i / frame.width) - 0.5) / focal_px;
        double ahead_m = depth_m + moved.z;
        if (ahead_m <= 0) return std::numeric_limits<double>::infinity();
        double key_right = (depth_m * right + moved.x) / ahead_m, key_up = (depth_m * up + moved.y) / ahead_m;
        return focal_px * std::hypot(key_right - right, key_up - up);
    };
    std::vector<float> parallax(frame.depth_m.size());
    for (size_t i = 0; i < parallax.size(); ++i) parallax[i] = float(parallax_of(i));
    return parallax;
}

ParallaxTally::ParallaxTally() {
    for (size_t i = 0; i < bins_.size(); ++i) {
        bins_[i].from_px = kEdges_px[i];
        bins_[i].to_px = i + 1 < bins_.size() ? kEdges_px[i + 1] : std::numeric_limits<double>::infinity();
    }
}

void ParallaxTally::add(std::span<const float> parallax_px, std::span<const Reused> pixels) {
    assert(parallax_px.size() == pixels.size());
    for (size_t i = 0; i < pixels.size(); ++i) {
        if (pixels[i] == Reused::nothing_there) continue;
        assert(parallax_px[i] >= 0);
        auto above = std::upper_bound(kEdges_px.begin(), kEdges_px.end(), double(parallax_px[i]));
        ParallaxBin& bin = bins_[size_t(above - kEdges_px.begin()) - 1];
        bin.asked_px += pixels[i] != Reused::near;
        bin.near_px += pixels[i] == Reused::near;
        bin.ghosts_px += pixels[i] == Reused::ghost;
        bin.losses_px += pixels[i] == Reused::loss;
    }
}

ParallaxBin ParallaxTally::up_to(double edge_px) const {
    assert(std::find(kEdges_px.begin(), kEdges_px.end(), edge_px) != kEdges_px.end());
    ParallaxBin all{0, edge_px, 0, 0, 0, 0};
    for (const ParallaxBin& bin : bins_) {
        if (bin.to_px > edge_px) continue;
        all.asked_px += bin.asked_px;
        all.ghosts_px += bin.ghosts_px;
        all.losses_px += bin.losses_px;
        all.near_px += bin.near_px;
    }
    return all;
}

}  // namespace overlook::measure
