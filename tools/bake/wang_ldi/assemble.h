// From samples and their colours to an image as it is stored.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formats/wang_ldi.h"
#include "tools/bake/wang_ldi/sample.h"

namespace overlook::wang_ldi {

// On the octahedron's square, -127..127; `normal` of any length but 0.
std::array<int8_t, 2> code_of_normal(const glm::vec3& normal);

// Which eyes image (level, direction) of a set is for.
Wedge wedge_of(const ImageSet& set, uint32_t level, uint32_t direction);

// colours: [samples] linear. Samples that come to one step of height in a pixel become one, of the one met more often.
Ldi assembled(const ImageSet& set, uint32_t level, const Sampled& sampled, std::span<const glm::vec3> colours);

}  // namespace overlook::wang_ldi
