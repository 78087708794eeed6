#include "tools/measure/reuse_truth.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "tools/measure/capture.h"
#include "tools/measure/terrain_method.h"

namespace overlook::measure {
namespace {

constexpr double kTolerance = 0.001;  // of the depth
constexpr double kSteepest = 0.01;    // of the depth: what the four texels of a slope differ by at most
constexpr double kSlopePart = 0.5;    // of that difference, allowed besides

bool is_same(const view::Camera& a, const view::Camera& b) {
    return a.position_m == b.position_m && a.heading_deg == b.heading_deg && a.pitch_deg == b.pitch_deg &&
           a.fov_y_deg == b.fov_y_deg && a.near_m == b.near_m && a.width_px == b.width_px && a.height_px == b.height_px;
}

}  // namespace

std::vector<uint8_t> seen_by(const view::Camera& key, std::span<const float> key_depth_m, const Frame& frame) {
    assert(key_depth_m.size() == size_t(key.width_px) * key.height_px);
    view::Axes from = view::axes_of(frame.camera), to = view::axes_of(key);
    double focal_px = view::focal_px(frame.camera), key_focal_px = view::focal_px(key);
    auto is_seen = [&](size_t i) {
        double depth_m = double(frame.depth_m[i]);
        if (!std::isfinite(depth_m)) return false;
        double right = (double(i % frame.width) + 0.5 - frame.width / 2.0) / focal_px;
        double up = (frame.height / 2.0 - double(i / frame.width) - 0.5) / focal_px;
        glm::dvec3 at_m = frame.camera.position_m - key.position_m + depth_m * (from.forward + right * from.right + up * from.up);
        double z_m = glm::dot(at_m, to.forward);
        if (z_m <= key.near_m) return false;
        double x = std::floor(key.width_px / 2.0 + key_focal_px * glm::dot(at_m, to.right) / z_m - 0.5);
        double y = std::floor(key.height_px / 2.0 - key_focal_px * glm::dot(at_m, to.up) / z_m - 0.5);
        if (x < 0 || y < 0 || x + 1 >= key.width_px || y + 1 >= key.height_px) return false;
        const float* texel = &key_depth_m[size_t(y) * key.width_px + size_t(x)];
        auto [nearest_m, farthest_m] = std::minmax({texel[0], texel[1], texel[key.width_px], texel[key.width_px + 1]});
        double slope_m = std::min(double(farthest_m) - double(nearest_m), kSteepest * z_m);
        return std::isinf(farthest_m) || z_m <= double(farthest_m) + kTolerance * z_m + kSlopePart * slope_m;
    };
    std::vector<uint8_t> seen(frame.depth_m.size());
    for (size_t i = 0; i < seen.size(); ++i) seen[i] = is_seen(i);
    return seen;
}

ReuseTruth::ReuseTruth(World& world) : full_(world) {}

Result<Frame> ReuseTruth::full_geometry(const view::Camera& camera) {
    Result<gl::Target> target = gl::Target::make(camera.width_px, camera.height_px, 1);
    if (!target) return tl::unexpected(target.error());
    full_.draw(*target, camera);
    return captured(*target, *target, camera);
}

Result<Reuse> ReuseTruth::reuse(const Sources& sources, const Frame& truth) {
    size_t count = truth.ids.size();
    assert(sources.of_pixel.size() == count);
    std::vector<std::vector<uint8_t>> seen;
    for (const view::Camera& key : sources.keys) {
        auto kept = std::find_if(keys_.begin(), keys_.end(), [&](const Frame& one) { return is_same(one.camera, key); });
        if (kept == keys_.end()) {
            Result<Frame> drawn = full_geometry(key);
            if (!drawn) return tl::unexpected(drawn.error());
            if (keys_.size() == kMostKept) keys_.pop_front();
            kept = keys_.insert(keys_.end(), std::move(*drawn));
        }
        seen.push_back(seen_by(key, kept->depth_m, truth));
    }
    std::vector<uint8_t> surface(count), used(count), visible(count);
    Reuse reuse;
    reuse.is_ghost.resize(count);
    reuse.is_loss.resize(count);
    size_t near_px = 0;
    for (size_t i = 0; i < count; ++i) {
        uint8_t source = sources.of_pixel[i];
        surface[i] = truth.ids[i] != kBackground;
        if (source == Sources::kNear) {
            near_px += surface[i];
            continue;
        }
        used[i] = source != 0 && source != Sources::kOwn;
        visible[i] = used[i];
        for (size_t k = 0; k < seen.size(); ++k) {
            if (used[i] && (source >> k & 1) != 0) visible[i] = visible[i] && seen[k][i];
            if (!used[i]) visible[i] = visible[i] || seen[k][i];
        }
        reuse.is_ghost[i] = surface[i] && used[i] && !visible[i];
        reuse.is_loss[i] = surface[i] && !used[i] && visible[i];
    }
    reuse.errors = reuse_errors(surface, used, visible);
    if (reuse.errors.surface_px > 0) reuse.near_share = double(near_px) / double(reuse.errors.surface_px);
    return reuse;
}

}  // namespace overlook::measure
