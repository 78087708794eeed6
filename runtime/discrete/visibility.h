// In which order places of a thing appear when a level fades in.
//
// Based on: D. Scherzer, M. Wimmer, Frame Sequential Interpolation for Discrete Level-of-Detail Rendering, 2008, 3.3.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "formats/discrete.h"

namespace overlook::discrete {

constexpr uint32_t kNoiseSide = 64;

// Uniform noise of kNoiseSide x kNoiseSide, by the paper's lookup: every value 0..255 stands equally often. The same bytes
// always.
Visibility uniform_noise(double period_m);

// What a chain's changes use: its own, one for all of them spread out, or noise whose period is the chain's radius. [levels - 1],
// or one if there is but one level.
std::vector<Visibility> visibilities_of(const Chain& chain);

// 0..1 at a place of the thing at rest, metres from the chain's own world's origin and from origin_m. grain: times the period.
double visibility_at(const Visibility& visibility, const glm::dvec3& at_m, const glm::dvec3& from_origin_m, double grain = 1);

}  // namespace overlook::discrete
