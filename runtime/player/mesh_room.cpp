#include "runtime/player/mesh_room.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overlook::player {
namespace {

constexpr double kOverviewFov_deg = 42, kOverviewHeading_deg = -30, kOverviewPitch_deg = -20, kOverviewMargin = 1.1;
constexpr double kNearShare = 1e-6;        // of the mesh's size; depths are reversed floats, so this costs no precision
constexpr double kLeastSpeedShare = 0.05;  // of the mesh's size in a second

}  // namespace

double MeshRoom::radius_m() const {
    return std::max(glm::distance(mesh().lowest_m(), mesh().highest_m()) / 2, 1e-6);
}

view::Camera MeshRoom::overview(uint32_t width_px, uint32_t height_px) const {
    view::Camera camera;
    camera.width_px = width_px, camera.height_px = height_px;
    camera.fov_y_deg = kOverviewFov_deg, camera.heading_deg = kOverviewHeading_deg, camera.pitch_deg = kOverviewPitch_deg;
    // As near as all corners of the box allow.
    view::Axes axes = view::axes_of(camera);
    glm::dvec3 low_m = mesh().lowest_m(), high_m = mesh().highest_m(), middle_m = (low_m + high_m) / 2.0;
    double tangent_y = std::tan(camera.fov_y_deg * std::numbers::pi / 360), tangent_x = tangent_y * width_px / height_px;
    double away_m = 0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 at_m((corner & 1) != 0 ? high_m.x : low_m.x, (corner & 2) != 0 ? high_m.y : low_m.y,
                        (corner & 4) != 0 ? high_m.z : low_m.z);
        at_m -= middle_m;
        double side_m = std::max(std::abs(glm::dot(at_m, axes.right)) / tangent_x, std::abs(glm::dot(at_m, axes.up)) / tangent_y);
        away_m = std::max(away_m, kOverviewMargin * side_m - glm::dot(at_m, axes.forward));
    }
    camera.position_m = middle_m - axes.forward * (away_m + kNearShare * radius_m());
    return camera;
}

double MeshRoom::near_m() const {
    return std::min(0.5, kNearShare * radius_m());
}

double MeshRoom::distance_m(const glm::dvec3& place_m) const {
    return glm::distance(place_m, glm::clamp(place_m, mesh().lowest_m(), mesh().highest_m()));
}

double MeshRoom::least_speed_m_s() const {
    return kLeastSpeedShare * radius_m();
}

caveclod::DrawOptions look_of(const FrameStyle& style, const LayerMethod& layer) {
    caveclod::DrawOptions look;
    look.is_wireframe = style.look.look == terrain::Look::wireframe;
    look.culls_back_faces = layer.mesh.settings.culls_back_faces;
    return look;
}

void take_counts(const caveclod::FrameCounts& counts, FrameRecord& record) {
    record.triangle_count = counts.triangle_count;
    record.tested_count = counts.evaluated_count;
    record.uploaded_bytes += counts.uploaded_bytes;
    record.predicted_error_px = counts.error_px;
    record.mesh = counts;
}

}  // namespace overlook::player
