#include "runtime/wang_ldi/perspective_warp.h"

#include <algorithm>
#include <cmath>

#include "formats/caveclod_octahedral.h"
#include "runtime/view/picture_rays.h"
#include "runtime/wang_ldi/brush.h"
#include "runtime/wang_ldi/pixel_grid.h"

namespace overlook::wang_ldi {
namespace {

// Patches that are seen more from the side are taken for patches seen so: a leaf's rim in a pixel is no plane that goes on.
constexpr float kLeastFacing = 0.25f;

// A place on a side of `count` pixels as a pixel's number; -1 or count beyond it.
int64_t pixel_at(double at_px, uint32_t count) {
    return int64_t(std::clamp(std::floor(at_px), -1.0, double(count)));
}

}  // namespace

view::Camera camera_of(const PerspectiveView& view) {
    view::Camera camera;
    camera.position_m = view.position_m, camera.heading_deg = view.heading_deg, camera.pitch_deg = view.pitch_deg;
    camera.fov_y_deg = view.fov_y_deg, camera.width_px = view.width_px, camera.height_px = view.height_px;
    camera.near_m = view.near_m;
    return camera;
}

Epipole epipole_of(const PerspectiveView& view, const glm::dvec3& eye_m) {
    view::PictureRays rays(camera_of(view));
    glm::dvec3 from = eye_m - view.position_m;
    double right = glm::dot(rays.axes.right, from), up = glm::dot(rays.axes.up, from), ahead = glm::dot(rays.axes.forward, from);
    // Beside the image's eye the epipole is at infinity, towards the other eye.
    auto scaled = [&](double across) { return across == 0 ? 0 : rays.focal * across / (ahead == 0 ? 1e-300 : ahead); };
    return {pixel_at(rays.middle_px.x + scaled(right), view.width_px), pixel_at(rays.middle_px.y - scaled(up), view.height_px),
            ahead >= 0};
}

uint32_t in_order(uint32_t i, int64_t epipole, bool is_towards, uint32_t count) {
    return towards(is_towards ? i : count - 1 - i, epipole, count);
}

PerspectiveWarper::PerspectiveWarper(const PerspectiveLdi& image) : view_(image.view), first_(image.first) {
    view::PictureRays rays(camera_of(view_));
    samples_.reserve(image.sample_count());
    for (uint32_t p = 0; p + 1 < first_.size(); ++p) {
        glm::dvec3 along = rays.through_pixel(p % view_.width_px, p / view_.width_px);
        for (uint32_t s = first_[p]; s < first_[p + 1]; ++s) {
            Sample sample;
            const auto& colour = image.colours[s];
            sample.depth_m = float(depth_of_code(view_, image.depths[s]));
            sample.colour = uint32_t(colour[0]) | uint32_t(colour[1]) << 8 | uint32_t(colour[2]) << 16 | 0xff000000u;
            if (!image.normals.empty()) {
                glm::dvec2 at = glm::dvec2(image.normals[s][0], image.normals[s][1]) / 127.0;
                glm::dvec3 normal = caveclod::vector_of_octahedral(at);
                sample.normal = glm::vec3(normal), sample.facing = float(glm::dot(normal, along));
            }
            samples_.push_back(sample);
        }
    }
}

// The plane patch of a pixel at depth z along ray r takes (z / focal)^2 / |n . r| of area, and shows focal'^2 |n . r'| / z'^2 of
// it elsewhere, where it lies at z' along r'.
template <class Brush>
void PerspectiveWarper::draw(const view::Camera& camera, const PatchRule& rule, Brush& brush) const {
    Eye eye(camera);
    view::PictureRays rays(camera_of(view_));
    glm::dvec3 offset_m = view_.position_m - camera.position_m;
    glm::vec3 offset = eye.seen(offset_m), off_m(offset_m);
    auto wide = float(double(rule.scale) * eye.focal_px / rays.focal);
    Epipole epipole = epipole_of(view_, camera.position_m);
    // A pixel's ray as the camera sees it, in equal steps from column to column and from row to row.
    glm::dvec3 corner = rays.through_pixel(0, 0), right = rays.axes.right / rays.focal, down = -rays.axes.up / rays.focal;
    for (uint32_t j = 0; j < view_.height_px; ++j) {
        uint32_t row = in_order(j, epipole.row, epipole.is_towards, view_.height_px);
        glm::vec3 start = eye.seen(corner + double(row) * down), step = eye.seen(right);
        for (uint32_t i = 0; i < view_.width_px; ++i) {
            uint32_t column = in_order(i, epipole.column, epipole.is_towards, view_.width_px);
            size_t pixel = size_t(row) * view_.width_px + column;
            uint32_t first = first_[pixel], count = first_[pixel + 1] - first;
            if (count == 0) continue;
            glm::vec3 along = start + float(column) * step;
            bool is_farthest_last = along.z < 0;  // the camera looks back
            for (uint32_t k = 0; k < count; ++k) {
                const Sample& sample = samples_[is_farthest_last ? first + k : first + count - 1 - k];
                glm::vec3 at = offset + sample.depth_m * along;
                float shown = std::abs(glm::dot(sample.normal, off_m) + sample.depth_m * sample.facing) / at.z;
                float share = std::max(shown, kLeastFacing) / std::max(std::abs(sample.facing), kLeastFacing);
                brush.splat(at, wide * sample.depth_m * std::sqrt(share) + rule.wider_px * at.z, sample.colour);
            }
        }
    }
}

WarpCounts PerspectiveWarper::warp(const view::Camera& camera, Hiding hiding, Warped& picture, const PatchRule& rule) const {
    Eye eye(camera);
    WarpCounts counts;
    if (hiding == Hiding::by_order) {
        Brush brush(eye, PictureTarget<Hiding::by_order>(picture), counts);
        draw(camera, rule, brush);
    } else {
        Brush brush(eye, PictureTarget<Hiding::by_depth>(picture), counts);
        draw(camera, rule, brush);
    }
    return counts;
}

}  // namespace overlook::wang_ldi
