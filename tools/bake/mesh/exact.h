// Decided exactly, whatever floating point would round.
#pragma once

#include <glm/vec3.hpp>

namespace overlook::mesh {

// Whether three points lie on one line (or together). Finite. Exact: an approximation with a proven bound decides nearly always,
// sums without rounding the rest.
bool are_on_one_line(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

}  // namespace overlook::mesh
