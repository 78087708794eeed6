// Which ground covers which faces of a landscape's mesh: cleaned up, and made to meet as asked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/make_sample/mesh_grid.h"

namespace overlook::sample {

// Connected regions of fewer faces than least_count become part of the ground that they border on most; the smallest first. O(F
// n) for the n rounds that it takes.
void drop_islands(const MeshGrid& grid, uint32_t least_count, std::vector<uint32_t>& surface);

// A place where as many different grounds meet in one position as `surfaces` has, at most six: round it they reach `radius_cells`
// far, one after another by their direction, so that those that lie there already go on and the others are outcrops. The position
// is the one, from first_row on and at least 3 radius_cells from the border, round which most faces within that distance keep
// what they have; of those the first. Returns it.
uint32_t make_meeting(const MeshGrid& grid, std::span<const uint32_t> surfaces, double radius_cells, uint32_t first_row,
                      std::vector<uint32_t>& surface);

}  // namespace overlook::sample
