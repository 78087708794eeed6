#include "runtime/lod_sprite/paper_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overlook::lod_sprite::paper {
namespace {

double angle_rad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Facet {
    glm::dvec3 a, b, c;
};

// The triangle of the low-resolution surface that the ray from `eye` through the centre meets first, or would if it were longer.
Facet facet_met(const QuadrantShape& q, const glm::dvec3& eye_m, Plane plane) {
    const glm::dvec3& nw = q.corners[0];
    const glm::dvec3& ne = q.corners[1];
    const glm::dvec3& se = q.corners[2];
    const glm::dvec3& sw = q.corners[3];
    glm::dvec3 fan_middle = (nw + ne + se + sw) / 4.0;
    glm::dvec3 diagonal_middle = q.is_main_diagonal ? (nw + se) / 2.0 : (ne + sw) / 2.0;
    const glm::dvec3& middle = plane == Plane::fan ? fan_middle : diagonal_middle;

    double onward = q.centre.z >= middle.z ? 1 : -1;
    double east = onward * (q.centre.x - eye_m.x) / (ne.x - nw.x), north = onward * (q.centre.y - eye_m.y) / (nw.y - sw.y);
    if (plane == Plane::drawn) {
        if (q.is_main_diagonal) return east + north >= 0 ? Facet{nw, se, ne} : Facet{nw, sw, se};
        return east - north >= 0 ? Facet{sw, se, ne} : Facet{sw, ne, nw};
    }
    if (std::abs(east) >= std::abs(north)) return east >= 0 ? Facet{middle, se, ne} : Facet{middle, nw, sw};
    return north >= 0 ? Facet{middle, ne, nw} : Facet{middle, sw, se};
}

// A camera's frame as planes through its eye; a direction is outside where any is negative.
class Frame {
  public:
    explicit Frame(const view::Camera& camera) : eye_m_(camera.position_m), axes_(view::axes_of(camera)), near_m_(camera.near_m) {
        double focal = view::focal_px(camera);
        tangent_x_ = camera.width_px / (2 * focal), tangent_y_ = camera.height_px / (2 * focal);
    }
    // Bits of the sides that a point is beyond.
    uint32_t beyond(const glm::dvec3& place_m) const {
        glm::dvec3 p = place_m - eye_m_;
        double x = glm::dot(p, axes_.right), y = glm::dot(p, axes_.up), depth = glm::dot(p, axes_.forward);
        double wide = depth * tangent_x_, high = depth * tangent_y_;
        return uint32_t(x < -wide) | uint32_t(x > wide) << 1 | uint32_t(y < -high) << 2 | uint32_t(y > high) << 3 |
               uint32_t(depth < near_m_) << 4;
    }

  private:
    glm::dvec3 eye_m_;
    view::Axes axes_;
    double near_m_, tangent_x_, tangent_y_;
};

// Single cells may have a void corner: that one is left out by putting it where a drawn one is.
QuadrantShape shape_of(const terrain::Terrain& terrain, const Quadrant& q) {
    uint32_t drawn_row = q.is_main_diagonal ? q.row0 : q.row1;
    auto corner = [&](uint32_t column, uint32_t row) {
        return terrain.is_void(column, row) ? place_of(terrain, q.column0, drawn_row) : place_of(terrain, column, row);
    };
    QuadrantShape shape{
        {corner(q.column0, q.row0), corner(q.column1, q.row0), corner(q.column1, q.row1), corner(q.column0, q.row1)},
        {},
        q.is_main_diagonal};
    shape.centre = q.has_centre() ? place_of(terrain, q.centre_column(), q.centre_row()) : shape.corners[0];
    return shape;
}

bool is_in_view(const Frame& frame, const QuadrantShape& shape) {
    uint32_t beyond = frame.beyond(shape.centre);
    for (const glm::dvec3& corner : shape.corners) beyond &= frame.beyond(corner);
    return beyond == 0;
}

}  // namespace

double parallax_rad(const QuadrantShape& quadrant, const glm::dvec3& key_eye_m, const glm::dvec3& now_eye_m, Plane plane) {
    Facet facet = facet_met(quadrant, key_eye_m, plane);
    glm::dvec3 ray = quadrant.centre - key_eye_m, normal = glm::cross(facet.b - facet.a, facet.c - facet.a);
    glm::dvec3 true_way = quadrant.centre - now_eye_m;
    double reached = glm::dot(normal, facet.a - key_eye_m), along = glm::dot(normal, ray);
    bool is_met = along > 0 ? reached > 0 : reached < 0;
    if (!is_met) return angle_rad(ray, true_way);
    return angle_rad(key_eye_m + ray * (reached / along) - now_eye_m, true_way);
}

double pixel_angle_rad(const view::Camera& camera) {
    return camera.fov_y_deg * std::numbers::pi / 180 / camera.height_px;
}

ErrorFigures ErrorMetric::measure(const view::Camera& key, const view::Camera& now, const terrain::Cut& low) {
    const std::vector<Quadrant>& quadrants = options_.levels == kCutLevels
                                                 ? quadrants_.of_cut(terrain_, low)
                                                 : quadrants_.of_level(terrain_, uint32_t(std::max(options_.levels, 0)));
    ErrorFigures figures;
    Frame frame(now);
    double sum = 0;
    angles_rad_.clear();
    for (const Quadrant& quadrant : quadrants) {
        QuadrantShape shape = shape_of(terrain_, quadrant);
        if (!is_in_view(frame, shape)) continue;
        double angle = quadrant.has_centre() ? parallax_rad(shape, key.position_m, now.position_m, options_.plane) : 0;
        figures.with_centre_count += quadrant.has_centre();
        sum += angle * angle;
        angles_rad_.push_back(angle);
    }
    figures.quadrant_count = angles_rad_.size();
    if (angles_rad_.empty()) return figures;

    double pixel = pixel_angle_rad(now);
    auto p99 = angles_rad_.begin() + ptrdiff_t(std::ceil(0.99 * double(angles_rad_.size()))) - 1;
    std::nth_element(angles_rad_.begin(), p99, angles_rad_.end());
    figures.rms_px = std::sqrt(sum / double(angles_rad_.size())) / pixel;
    figures.p99_px = *p99 / pixel;
    figures.max_px = *std::max_element(p99, angles_rad_.end()) / pixel;
    return figures;
}

}  // namespace overlook::lod_sprite::paper
