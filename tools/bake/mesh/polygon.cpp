// Ear clipping.

#include "tools/bake/mesh/polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace overlook::mesh {
namespace {

// Twice the polygon's area as a vector: its direction is the mean normal.
glm::dvec3 area_vector(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum{0};
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i] - corners[0], b = corners[i + 1 < corners.size() ? i + 1 : 0] - corners[0];
        sum += glm::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    }
    return sum;
}

// Whether no corner is farther from the polygon's plane than a fifth of the polygon's size.
bool is_flat(std::span<const glm::dvec3> corners, const glm::dvec3& area) {
    const double length = glm::length(area);
    double size = 0, least = 0, most = 0;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 from_first = corner - corners[0];
        const double height = length > 0 ? glm::dot(from_first, area) / length : 0;
        least = std::min(least, height);
        most = std::max(most, height);
        size = std::max(size, glm::length(from_first));
    }
    return most - least <= 0.2 * size;
}

}  // namespace

// Drops the axis along which the area is largest, so that turning left stays turning left.
void PolygonCutter::project(std::span<const glm::dvec3> corners, const glm::dvec3& area) {
    const double x = std::abs(area.x), y = std::abs(area.y), z = std::abs(area.z);
    points_.clear();
    for (const glm::dvec3& corner : corners) {
        if (z >= x && z >= y)
            points_.push_back(area.z >= 0 ? Point{corner.x, corner.y} : Point{corner.y, corner.x});
        else if (x >= y)
            points_.push_back(area.x >= 0 ? Point{corner.y, corner.z} : Point{corner.z, corner.y});
        else
            points_.push_back(area.y >= 0 ? Point{corner.z, corner.x} : Point{corner.x, corner.z});
    }
}

// Positive if a, b, c turn left.
double PolygonCutter::turn(uint32_t a, uint32_t b, uint32_t c) const {
    const Point &p = points_[a], &q = points_[b], &r = points_[c];
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

// A corner that turns left and whose triangle no reflex corner lies in. Corners at the same place as the triangle's do not count:
// so holes that are joined to the rim by an edge walked twice are cut rightly.
bool PolygonCutter::is_ear(uint32_t b) {
    const uint32_t a = previous_[b], c = next_[b];
    if (!(turn(a, b, c) > 0)) return false;
    tests_left_ -= reflex_.size();
    const auto is_at = [&](uint32_t i, uint32_t j) { return points_[i].x == points_[j].x && points_[i].y == points_[j].y; };
    for (const uint32_t i : reflex_) {
        if (!is_reflex_[i] || is_at(i, a) || is_at(i, b) || is_at(i, c)) continue;
        if (turn(a, b, i) >= 0 && turn(b, c, i) >= 0 && turn(c, a, i) >= 0) return false;
    }
    return true;
}

void PolygonCutter::clip(uint32_t b) {
    const uint32_t a = previous_[b], c = next_[b];
    triangles_.push_back({a, b, c});
    next_[a] = c;
    previous_[c] = a;
    is_reflex_[b] = 0;
    for (const uint32_t i : {a, c})
        if (is_reflex_[i] && turn(previous_[i], i, next_[i]) > 0) is_reflex_[i] = 0;
}

void PolygonCutter::fan(uint32_t count) {
    for (uint32_t i = 1; i + 1 < count; ++i) triangles_.push_back({0, i, i + 1});
}

void PolygonCutter::link(uint32_t count) {
    previous_.resize(count);
    next_.resize(count);
    is_reflex_.assign(count, 0);
    reflex_.clear();
    for (uint32_t i = 0; i < count; ++i) {
        previous_[i] = i == 0 ? count - 1 : i - 1;
        next_[i] = i + 1 == count ? 0 : i + 1;
    }
    for (uint32_t i = 0; i < count; ++i) {
        if (turn(previous_[i], i, next_[i]) > 0) continue;
        is_reflex_[i] = 1;
        reflex_.push_back(i);
    }
}

bool PolygonCutter::clip_ears(uint32_t count) {
    uint32_t corner = 0, tried = 0;
    for (uint32_t left = count; left > 3;) {
        // Once round without an ear: the polygon crosses itself or has no area here.
        const bool has_none = tried > left;
        if (!has_none && tests_left_ < reflex_.size()) return false;
        if (!has_none && !is_ear(corner)) {
            corner = next_[corner];
            ++tried;
            continue;
        }
        clip(corner);
        corner = next_[next_[corner]];
        --left;
        tried = 0;
    }
    triangles_.push_back({previous_[corner], corner, next_[corner]});
    return true;
}

std::span<const Corners> PolygonCutter::cut(std::span<const glm::dvec3> corners) {
    const uint32_t count = uint32_t(corners.size());
    triangles_.clear();
    if (count == 3) {
        triangles_.push_back({0, 1, 2});
        return triangles_;
    }
    const glm::dvec3 area = area_vector(corners);
    if (!is_flat(corners, area)) {
        fan(count);
        return triangles_;
    }
    project(corners, area);
    link(count);
    if (reflex_.empty())
        fan(count);
    else if (!clip_ears(count))
        return {};
    return triangles_;
}

}  // namespace overlook::mesh
