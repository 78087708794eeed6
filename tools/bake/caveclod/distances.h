// Distances from points to segments and triangles.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace overlook::caveclod {

inline double distance2_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    glm::dvec3 along = b - a, from = p - a;
    double length2 = glm::dot(along, along);
    double share = length2 > 0 ? std::clamp(glm::dot(from, along) / length2, 0.0, 1.0) : 0;
    glm::dvec3 off = from - along * share;
    return glm::dot(off, off);
}

// A triangle made ready for many points.
struct TriangleProbe {
    glm::dvec3 a, b, c, normal;  // normal: of any length
    double inverse_normal2 = 0;  // 0 where the triangle is degenerate
};

inline TriangleProbe probe_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    glm::dvec3 normal = glm::cross(b - a, c - a);
    double normal2 = glm::dot(normal, normal);
    return {a, b, c, normal, normal2 > 0 ? 1 / normal2 : 0};
}

// Which sides of a triangle a point lies beyond, as seen along its normal.
struct Beyond {
    bool ab = false, bc = false, ca = false;
};

// Squared distance of p to the closed triangle: to its plane where p lies over the inside, else to the nearest of the sides that
// p lies beyond (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
inline double distance2_to_triangle(const glm::dvec3& p, const TriangleProbe& t, const Beyond& beyond) {
    if (!beyond.ab && !beyond.bc && !beyond.ca && t.inverse_normal2 > 0) {
        double height = glm::dot(p - t.a, t.normal);
        return height * height * t.inverse_normal2;
    }
    bool is_flat = t.inverse_normal2 == 0;
    double least = 1e300;
    if (beyond.ab || is_flat) least = std::min(least, distance2_to_segment(p, t.a, t.b));
    if (beyond.bc || is_flat) least = std::min(least, distance2_to_segment(p, t.b, t.c));
    if (beyond.ca || is_flat) least = std::min(least, distance2_to_segment(p, t.c, t.a));
    return least;
}

inline double distance2_to_triangle(const glm::dvec3& p, const TriangleProbe& t) {
    glm::dvec3 pa = p - t.a, pb = p - t.b, pc = p - t.c;
    return distance2_to_triangle(p, t,
                                 {glm::dot(glm::cross(pa, pb), t.normal) < 0, glm::dot(glm::cross(pb, pc), t.normal) < 0,
                                  glm::dot(glm::cross(pc, pa), t.normal) < 0});
}

// One that very many points are held against: its sides' normals, which point inwards, are at hand as well.
struct SidedProbe : TriangleProbe {
    glm::dvec3 inward_ab, inward_bc, inward_ca;
};

inline SidedProbe sided_probe_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    TriangleProbe t = probe_of(a, b, c);
    return {t, glm::cross(t.normal, b - a), glm::cross(t.normal, c - b), glm::cross(t.normal, a - c)};
}

inline double distance2_to_triangle(const glm::dvec3& p, const SidedProbe& t) {
    return distance2_to_triangle(
        p, t, {glm::dot(p - t.a, t.inward_ab) < 0, glm::dot(p - t.b, t.inward_bc) < 0, glm::dot(p - t.c, t.inward_ca) < 0});
}

// Where on the segment a-b the point nearest to segment c-d lies, as a share 0..1 of the way from a to b.
inline double nearest_share(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
    glm::dvec3 u = b - a, v = d - c, w = a - c;
    double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), uw = glm::dot(u, w), vw = glm::dot(v, w);
    if (!(uu > 0)) return 0;
    double det = uu * vv - uv * uv;
    double s = det > 1e-14 * uu * vv ? std::clamp((uv * vw - vv * uw) / det, 0.0, 1.0) : 0.5;
    double t = vv > 0 ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0;
    return std::clamp((uv * t - uw) / uu, 0.0, 1.0);
}

// Weights of a triangle's corners at the point of its plane nearest to p, drawn into the triangle.
inline glm::dvec3 weights_at(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    glm::dvec3 normal = glm::cross(b - a, c - a);
    double normal2 = glm::dot(normal, normal);
    if (!(normal2 > 0)) return {1, 0, 0};
    glm::dvec3 weights(glm::dot(glm::cross(c - b, p - b), normal), glm::dot(glm::cross(a - c, p - c), normal),
                       glm::dot(glm::cross(b - a, p - a), normal));
    weights = glm::max(weights / normal2, glm::dvec3(0));
    return weights / (weights.x + weights.y + weights.z);
}

}  // namespace overlook::caveclod
