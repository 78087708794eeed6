// Where water goes on a grid of heights.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/make_sample/grid.h"

namespace overlook::sample {

// order: [n] every cell once, each after the one it drains to. receiver: [n] index of that one; an outlet's
// is itself. filled_m: [n] the height at which water leaves: the cell's own, or that of the lowest way out of
// its depression.
struct Drainage {
    std::vector<uint32_t> order;
    std::vector<uint32_t> receiver;
    std::vector<double> filled_m;
};

// Floods the heights from the outlets upward: a cell drains to its steepest lower neighbour, in a depression
// along the flood's way in. is_outlet: [n], at least one true. `wander` in 0..1 bends the choice of the
// neighbour by a hash of `seed`, so that valleys do not line up with the grid. O(n log n). (R. Barnes, C.
// Lehman, D. Mulla, Priority-Flood, Computers & Geosciences 62, 2014.)
Drainage drain(const Grid& height_m, const std::vector<uint8_t>& is_outlet, double wander, uint64_t seed);

// [n] square metres that drain through each cell, its own included.
std::vector<double> drained_area_m2(const Drainage& drainage, double cell_m);

}  // namespace overlook::sample
