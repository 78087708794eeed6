#include "runtime/lod_sprite/reuse.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "runtime/lod_sprite/projector.h"
#include "runtime/lod_sprite/shown.h"

namespace overlook::lod_sprite {
namespace {

constexpr int kRaysASide = 12;  // that are asked whether the key saw what is there
constexpr size_t kErrorSteps = 256;
constexpr double kRoundingShare = 1e-9;  // of the frame: less is not lost but rounded

// A point of the key in the camera's picture: pixels from the middle, and depth.
struct Seen {
    double x = 0, y = 0, depth = -1;
};

Seen seen_at(const Projector& project, double share_x, double share_y, double depth_m) {
    glm::dvec3 at = project(share_x, share_y, depth_m);
    if (at.z <= 1e-9) return {};
    return {project.focal_px() * at.x / at.z, project.focal_px() * at.y / at.z, at.z};
}

// Errors by the area that has them.
class Histogram {
  public:
    void add(double error_px, double area) {
        size_t bits = std::bit_cast<uint32_t>(float(std::max(error_px, double(kLeast_px)))) >> kUnusedBits;
        size_t at = std::min(bits - (std::bit_cast<uint32_t>(kLeast_px) >> kUnusedBits), kErrorSteps - 1);
        areas_[at] += area;
        greatest_of_px_[at] = std::max(greatest_of_px_[at], error_px);
        sum_ += area;
        greatest_px_ = std::max(greatest_px_, error_px);
    }
    double percentile(double share) const {
        double below = 0;
        for (size_t i = 0; i < kErrorSteps; ++i) {
            below += areas_[i];
            if (below >= share * sum_) return greatest_of_px_[i];
        }
        return greatest_px_;
    }
    double greatest_px() const { return greatest_px_; }

  private:
    static constexpr float kLeast_px = 0.0078125f;
    static constexpr int kUnusedBits = 23 - 4;  // of a float's fraction: sixteen steps from one power of two to the next
    std::array<double, kErrorSteps> areas_{}, greatest_of_px_{};  // of each step
    double sum_ = 0, greatest_px_ = 0;
};

bool is_in_frame(const view::Camera& camera, const Seen& at) {
    return at.depth > 0 && std::abs(at.x) <= camera.width_px / 2.0 && std::abs(at.y) <= camera.height_px / 2.0;
}

// The share of the camera's rays that leave what the key saw, for a surface straight before it at the middle of its depths.
double outside_share_of(const Key& key, const view::Camera& camera) {
    std::vector<float> depths;
    for (size_t i = 0; i < key.depths.depth_m.size(); i += 7)
        if (std::isfinite(key.depths.depth_m[i])) depths.push_back(key.depths.depth_m[i]);
    double middle_m = std::numeric_limits<double>::infinity();
    if (!depths.empty()) {
        std::nth_element(depths.begin(), depths.begin() + ptrdiff_t(depths.size() / 2), depths.end());
        middle_m = depths[depths.size() / 2];
    }
    Link link = link_of(key.camera, camera);
    view::Axes axes = view::axes_of(camera);
    double focal_px = view::focal_px(camera);
    int outside = 0;
    for (int j = 0; j < kRaysASide; ++j)
        for (int i = 0; i < kRaysASide; ++i) {
            double x = ((i + 0.5) / kRaysASide - 0.5) * camera.width_px / focal_px;
            double y = ((j + 0.5) / kRaysASide - 0.5) * camera.height_px / focal_px;
            glm::dvec3 ray = link.key_from_world * (axes.forward + x * axes.right + y * axes.up);
            // Where the ray meets that surface; once past it, anything farther will do.
            double way_m = std::max(0.0, (middle_m - link.eye_m.z) / ray.z);
            glm::dvec3 at = std::isfinite(middle_m) ? link.eye_m + way_m * ray : ray;
            bool is_seen =
                ray.z > 0 && at.z > 0 && std::abs(at.x) <= link.tangents.x * at.z && std::abs(at.y) <= link.tangents.y * at.z;
            outside += !is_seen;
        }
    return double(outside) / (kRaysASide * kRaysASide);
}

}  // namespace

Reuse reuse_of(const Key& key, const view::Camera& camera, double fallback_error_px, double lost_error_px, const Shown* shown) {
    const DepthGrid& grid = key.depths;
    Projector project(key, camera);
    std::vector<Seen> seen(grid.depth_m.size());
    for (uint32_t y = 0; y < grid.height; ++y)
        for (uint32_t x = 0; x < grid.width; ++x) {
            size_t at = size_t(y) * grid.width + x;
            seen[at] = seen_at(project, (x + 0.5) / grid.width, (y + 0.5) / grid.height, double(grid.depth_m[at]));
        }

    double frame_area = double(camera.width_px) * camera.height_px;
    double cell_area = double(key.camera.width_px) * key.camera.height_px / (double(grid.width) * grid.height);
    Reuse reuse;
    Histogram errors, drawn_errors, magnifications;
    double opened = 0;
    for (uint32_t y = 0; y + 1 < grid.height; ++y)
        for (uint32_t x = 0; x + 1 < grid.width; ++x) {
            size_t at = size_t(y) * grid.width + x;
            const Seen &a = seen[at], &b = seen[at + 1], &c = seen[at + grid.width], &d = seen[at + grid.width + 1];
            if (a.depth <= 0 || b.depth <= 0 || c.depth <= 0 || d.depth <= 0) continue;
            if (!is_in_frame(camera, a) && !is_in_frame(camera, d)) continue;
            float depths[4] = {grid.depth_m[at], grid.depth_m[at + 1], grid.depth_m[at + grid.width],
                               grid.depth_m[at + grid.width + 1]};
            auto [nearest, farthest] = std::minmax_element(depths, depths + 4);
            // Right-handed as the key saw it: y goes down the grid and up the picture.
            double area = ((d.x - a.x) * (b.y - c.y) - (d.y - a.y) * (b.x - c.x)) / 2;
            if (!std::isfinite(*nearest)) continue;  // sky
            if (!(*farthest <= kSteepest * *nearest)) {
                // What is hidden behind the nearer side comes out as the cell grows more than that side does.
                size_t front = size_t(nearest - depths);
                const Seen& edge = front == 0 ? a : front == 1 ? b : front == 2 ? c : d;
                double growth = double(*nearest) / edge.depth;
                double stretch = project.stretch((x + 0.5) / grid.width, (y + 0.5) / grid.height, {edge.x, edge.y});
                opened += std::clamp(area - growth * growth * stretch * cell_area, 0.0, 64 * cell_area);
                continue;
            }
            if (area <= 0) continue;  // turned away by now
            double magnification = std::sqrt(area / cell_area);
            double key_depth = (depths[0] + depths[3]) / 2.0, depth = (a.depth + d.depth) / 2;
            errors.add(key.error_px * key_depth / depth, area);
            drawn_errors.add(key.error_px * key_depth / depth, area);
            magnifications.add(magnification / key.scale, area);
        }
    reuse.opened_share = std::min(1.0, opened / frame_area);
    reuse.outside_share = outside_share_of(key, camera);
    if (shown != nullptr) reuse.unproven_share = shown->behind_share + std::max(0.0, shown->nothing_share - reuse.outside_share);
    if (reuse.lost_share() > kRoundingShare) {
        errors.add(fallback_error_px, reuse.lost_share() * frame_area);
        drawn_errors.add(lost_error_px, reuse.lost_share() * frame_area);
    }
    reuse.magnification_p99 = magnifications.percentile(0.99);
    reuse.error_p99_px = errors.percentile(0.99);
    reuse.error_max_px = errors.greatest_px();
    reuse.drawn_p99_px = drawn_errors.percentile(0.99);
    // A step may be torn by less than what is drawn finer for.
    reuse.drawn_max_px = std::max(drawn_errors.greatest_px(), reuse.opened_share > kRoundingShare ? fallback_error_px : 0.0);
    return reuse;
}

}  // namespace overlook::lod_sprite
