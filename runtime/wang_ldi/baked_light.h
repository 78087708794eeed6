// The light that samples of images are lit by when they are baked, for whoever draws beside them what they were baked from.
#pragma once

#include <glm/glm.hpp>

namespace overlook::wang_ldi {

// Linear. What a white surface that faces the sun sends back of it, of the whole sky, and of the ground, which lies below the
// horizon everywhere; and how much light two-sided surfaces let through.
struct BakedLight {
    glm::vec3 sun{0.85f, 0.8f, 0.7f}, sky{0.3f, 0.36f, 0.45f}, ground{0.03f, 0.035f, 0.02f};
    float transmission = 0.35f;
};

}  // namespace overlook::wang_ldi
