// Positions and faces in an order in which neighbours in space are neighbours in memory.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "tools/bake/mesh.h"

namespace overlook::caveclod {

// Indices of the positions along a Z-order curve through their box (G. Morton, A Computer Oriented Geodetic Data Base, 1966), 21
// bits an axis; equal places by index. O(P log P).
std::vector<uint32_t> order_along_curve(std::span<const glm::vec3> positions_m);

// Indices of the faces by the least of rank[position] over their corners, equal ones by index. rank: [P], below P. O(F + P).
std::vector<uint32_t> order_by_least_corner(std::span<const mesh::Corners> faces, std::span<const uint32_t> rank);

}  // namespace overlook::caveclod
