// The nearest point of a triangle, for whoever bakes and whoever judges.
#pragma once

#include <glm/glm.hpp>

namespace overlook::view {

// The point of the closed triangle that is nearest to `place`, by the region of its plane that the place lies over (C. Ericson,
// Real-Time Collision Detection, 2005, section 5.1.5). Where the triangle has no area, one of its points as near as any, but for
// rounding.
inline glm::dvec3 nearest_in_triangle(const glm::dvec3& place, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    glm::dvec3 ab = b - a, ac = c - a, ap = place - a, bp = place - b, cp = place - c;
    double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 - d3 != 0 ? d1 / (d1 - d3) : 0);
    double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 - d6 != 0 ? d2 / (d2 - d6) : 0);
    double va = d3 * d6 - d5 * d4, to_b = d4 - d3, to_c = d5 - d6;
    if (va <= 0 && to_b >= 0 && to_c >= 0) return b + (c - b) * (to_b + to_c != 0 ? to_b / (to_b + to_c) : 0);
    double sum = va + vb + vc;
    return sum != 0 ? a + (ab * vb + ac * vc) / sum : a;
}

}  // namespace overlook::view
