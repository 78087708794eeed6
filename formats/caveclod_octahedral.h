// Directions as places on a square: the octahedron |x| + |y| + |z| = 1, its lower half folded outwards.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace overlook::caveclod {

// Each -1..1; `direction` of any length but 0.
inline glm::dvec2 octahedral_of(const glm::dvec3& direction) {
    double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    glm::dvec2 at = glm::dvec2(direction.x, direction.y) / sum;
    if (direction.z >= 0) return at;
    return {(1 - std::abs(at.y)) * (at.x < 0 ? -1 : 1), (1 - std::abs(at.x)) * (at.y < 0 ? -1 : 1)};
}

// Of length 1. Both places of a direction on the square's rim give the same bits.
inline glm::dvec3 vector_of_octahedral(const glm::dvec2& at) {
    double z = 1 - std::abs(at.x) - std::abs(at.y);
    glm::dvec3 direction(at.x, at.y, z);
    if (z < 0) {
        direction.x = (1 - std::abs(at.y)) * (at.x < 0 ? -1 : 1);
        direction.y = (1 - std::abs(at.x)) * (at.y < 0 ? -1 : 1);
    }
    return direction / std::sqrt(direction.x * direction.x + direction.y * direction.y + z * z) + 0.0;
}

}  // namespace overlook::caveclod
