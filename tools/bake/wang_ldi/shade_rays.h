// Directions about a place, and rays that ask what is in the way: what all that lights samples begins with.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "tools/bake/rays.h"

namespace overlook::wang_ldi {

constexpr float kLift = 1e-4f;  // off the surface, in metres: rays of 32 bits do not meet it again

// A frame about a direction of length 1 (T. Duff and others, Building an Orthonormal Basis, Revisited, 2017).
inline glm::mat3 frame_of(const glm::vec3& n) {
    float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {glm::vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), glm::vec3(b, sign + n.y * n.y * a, -n.y), n};
}

// Places i of count on the unit square, evenly spread, moved by a shift: i / count against the golden ratio.
inline glm::vec2 place_of(uint32_t i, uint32_t count, const glm::vec2& shift) {
    float x = (float(i) + 0.5f) / float(count) + shift.x, y = float(i) * 0.618033989f + shift.y;
    return {x - std::floor(x), y - std::floor(y)};
}

// Rays that are asked together: begin, add, shoot, and again.
struct ShadowRays {
    std::vector<rays::Ray> rays;
    std::vector<uint8_t> blocked;
    std::vector<rays::Ray>* asked = nullptr;  // where all rays that were shot are kept besides; null: nowhere

    void begin() { rays.clear(); }
    void add(const glm::vec3& from, const glm::vec3& along) { rays.push_back({from, along}); }
    void shoot(const rays::Scene& scene) {
        blocked.resize(rays.size());
        scene.are_blocked(rays, blocked);
        if (asked) asked->insert(asked->end(), rays.begin(), rays.end());
    }
};

}  // namespace overlook::wang_ldi
