// How much of the sun and of the sky is seen amid what is planted, by height: as if its leaves hung about at random.
//
// Based on: M. Monsi, T. Saeki, On the Factor Light in Plant Communities and its Importance for Matter Production, 1953 (Annals
// of Botany, 2005). Ours: leaf areas are those of the models that are planted.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "formats/discrete.h"
#include "formats/wang_tiles.h"

namespace overlook::wang_ldi {

constexpr uint32_t kCanopySteps = 32;
constexpr uint32_t kCanopyForm = 1;  // counts up when canopy_of() finds other shares

struct Canopy {
    double top_m = 0;  // nothing stands higher
    // Shares of the sun (x) and of the sky (y), 0..1, at heights of top_m k / (kCanopySteps - 1) above the ground.
    std::array<glm::vec2, kCanopySteps> open{};
};

// chains: one a model of the planting, whose finest levels count: surfaces that are seen from behind too with both sides, others
// as what they enclose. Leaves stand together in plants, whose tight radii they keep, and so shade each other more than if they
// hung everywhere. to_sun: of length 1. Everywhere 1 if nothing is planted.
// O(triangles of the finest levels + what is planted).
Canopy canopy_of(const Planting& planting, std::span<const discrete::Chain> chains, const glm::dvec3& to_sun);

}  // namespace overlook::wang_ldi
