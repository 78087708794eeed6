// The light amid what is planted, for plants that are drawn beside images: as these were lit when they were baked, but for
// shadows, which are what they are on average at a height.
#pragma once

#include "runtime/wang_ldi/baked_light.h"
#include "runtime/wang_ldi/canopy.h"

namespace overlook::wang_ldi {

struct PlantLight {
    bool is_lit = false;  // false: in their own colours
    glm::vec3 to_sun{0, 0, 1};
    BakedLight light;
    Canopy canopy;
};

}  // namespace overlook::wang_ldi
