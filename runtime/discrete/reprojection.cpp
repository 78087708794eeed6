#include "runtime/discrete/reprojection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overlook::discrete {
namespace {

// view::projection in double; and its inverse, which takes clip (x, y, near_m / depth, 1) to a place in the eye's axes.
glm::dmat4 exact_projection(const view::Camera& camera) {
    double focal = view::focal_px(camera);
    glm::dmat4 matrix(0);
    matrix[0][0] = 2 * focal / camera.width_px;
    matrix[1][1] = 2 * focal / camera.height_px;
    matrix[2][3] = -1;
    matrix[3][2] = camera.near_m;
    return matrix;
}

glm::dmat4 exact_unprojection(const view::Camera& camera) {
    double focal = view::focal_px(camera);
    glm::dmat4 matrix(0);
    matrix[0][0] = camera.width_px / (2 * focal);
    matrix[1][1] = camera.height_px / (2 * focal);
    matrix[3][2] = -1;
    matrix[2][3] = 1 / camera.near_m;
    return matrix;
}

glm::dmat4 exact_rotation(const view::Camera& camera) {
    view::Axes axes = view::axes_of(camera);
    glm::dmat4 matrix(1);
    for (int i = 0; i < 3; ++i) matrix[i][0] = axes.right[i], matrix[i][1] = axes.up[i], matrix[i][2] = -axes.forward[i];
    return matrix;
}

// Places relative to the new eye to places relative to the old one.
glm::dmat4 relative(const view::Camera& old_camera, const Placement& before, const view::Camera& new_camera,
                    const Placement& now) {
    double scale = before.scale / now.scale;
    double cosine = before.cosine * now.cosine + before.sine * now.sine,
           sine = before.sine * now.cosine - before.cosine * now.sine;
    glm::dmat4 matrix(1);
    matrix[0] = {scale * cosine, scale * sine, 0, 0};
    matrix[1] = {-scale * sine, scale * cosine, 0, 0};
    matrix[2] = {0, 0, scale, 0};
    glm::dvec3 moved_m =
        before.translation_m - old_camera.position_m - glm::dmat3(matrix) * (now.translation_m - new_camera.position_m);
    matrix[3] = glm::dvec4(moved_m, 1);
    return matrix;
}

glm::mat4 clip_from_clip(const view::Camera& to, const glm::dmat4& moved, const view::Camera& from) {
    return glm::mat4(exact_projection(to) * exact_rotation(to) * moved * glm::transpose(exact_rotation(from)) *
                     exact_unprojection(from));
}

// Tangents between which a circle of radius r round (side, forward) is seen; forward > r.
std::pair<double, double> tangents(double side, double forward, double radius) {
    double angle = std::atan2(side, forward), half = std::asin(std::min(radius / std::hypot(side, forward), 1.0));
    return {std::tan(angle - half), std::tan(angle + half)};
}

}  // namespace

Reprojection reprojection(const view::Camera& old_camera, const Placement& before, const view::Camera& new_camera,
                          const Placement& now) {
    return {clip_from_clip(old_camera, relative(old_camera, before, new_camera, now), new_camera),
            clip_from_clip(new_camera, relative(new_camera, now, old_camera, before), old_camera)};
}

Extent extent_of(const view::Camera& camera, const glm::dvec3& from_eye_m, double radius_m, int margin_px) {
    view::Axes axes = view::axes_of(camera);
    double forward = glm::dot(axes.forward, from_eye_m), focal = view::focal_px(camera);
    Extent extent{0, 0, int(camera.width_px), int(camera.height_px), 1, 0};
    if (forward + radius_m <= camera.near_m) return {};
    extent.far_z = float(camera.near_m / (forward + radius_m));
    if (forward - radius_m <= camera.near_m) return extent;
    extent.near_z = float(camera.near_m / (forward - radius_m));
    auto range = [&](double side, uint32_t size_px, int& first, int& last) {
        auto [low, high] = tangents(side, forward, radius_m);
        double middle_px = size_px / 2.0;
        first = int(std::clamp(std::floor(middle_px + focal * low) - margin_px, 0.0, double(size_px)));
        last = int(std::clamp(std::ceil(middle_px + focal * high) + margin_px, 0.0, double(size_px)));
    };
    range(glm::dot(axes.right, from_eye_m), camera.width_px, extent.left, extent.right);
    range(glm::dot(axes.up, from_eye_m), camera.height_px, extent.bottom, extent.top);
    double distance_m = glm::length(from_eye_m);
    extent.towards = glm::dvec3(glm::dot(axes.right, from_eye_m), glm::dot(axes.up, from_eye_m), forward) / distance_m;
    // No pixel is seen under a greater angle than those in the middle.
    extent.half_rad = std::asin(std::min(radius_m / distance_m, 1.0)) + std::sqrt(2.0) * margin_px / focal;
    return extent;
}

namespace {

// Cones round squares of a camera's picture.
class SquareCones {
  public:
    explicit SquareCones(const view::Camera& camera)
        : focal_px_(view::focal_px(camera)), middle_px_(glm::dvec2(camera.width_px, camera.height_px) / 2.0) {}
    // Does what is seen in a square reach into the extent's cone?
    bool meets(const Extent& extent, int column, int row) const {
        if (extent.half_rad >= std::numbers::pi) return true;
        constexpr double kSide = Tiles::kSide_px;
        glm::dvec2 low = glm::dvec2(column, row) * kSide - middle_px_;
        glm::dvec3 middle = glm::normalize(glm::dvec3(low + kSide / 2, focal_px_));
        double half_rad = 0;
        for (int corner = 0; corner < 4; ++corner) {
            glm::dvec3 at = glm::normalize(glm::dvec3(low + kSide * glm::dvec2(corner & 1, corner >> 1), focal_px_));
            half_rad = std::max(half_rad, angle(middle, at));
        }
        return angle(middle, extent.towards) <= half_rad + extent.half_rad + kRounding_rad;
    }

  private:
    static constexpr double kRounding_rad = 1e-9;
    static double angle(const glm::dvec3& a, const glm::dvec3& b) {
        return 2 * std::asin(std::min(glm::distance(a, b) / 2, 1.0));
    }
    double focal_px_;
    glm::dvec2 middle_px_;
};

}  // namespace

Tiles tiles_of(const view::Camera& camera, std::span<const Extent> extents) {
    constexpr int kSide = int(Tiles::kSide_px);
    Tiles tiles;
    tiles.columns = (camera.width_px + Tiles::kSide_px - 1) / Tiles::kSide_px;
    tiles.rows = (camera.height_px + Tiles::kSide_px - 1) / Tiles::kSide_px;
    tiles.entries.assign(size_t(tiles.columns) * tiles.rows * Tiles::kMost, 0);
    SquareCones cones(camera);
    for (size_t i = 0; i < extents.size(); ++i) {
        const Extent& extent = extents[i];
        if (extent.left >= extent.right || extent.bottom >= extent.top) continue;
        for (int row = extent.bottom / kSide; row <= (extent.top - 1) / kSide; ++row) {
            for (int column = extent.left / kSide; column <= (extent.right - 1) / kSide; ++column) {
                if (!cones.meets(extent, column, row)) continue;
                uint32_t* tile = &tiles.entries[(size_t(row) * tiles.columns + size_t(column)) * Tiles::kMost];
                uint32_t* room = std::find(tile, tile + Tiles::kMost, 0u);
                if (room == tile + Tiles::kMost)
                    ++tiles.dropped_count;
                else
                    *room = uint32_t(i) + 1;
            }
        }
    }
    return tiles;
}

}  // namespace overlook::discrete
