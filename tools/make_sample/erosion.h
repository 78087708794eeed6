// What shapes a landscape once it has been lifted: rivers, falling rock, creeping soil, ice.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/make_sample/grid.h"

namespace overlook::sample {

struct Rivers {
    double step = 0.15;  // time a step; a wave of incision runs up a river at sqrt(drained m2) metres a time unit
    int step_count = 10;
    double wander = 0.5;  // see drain()
    uint64_t seed = 1;
};

// Lifts the ground and lets rivers cut it, implicitly, so that any step is stable: dz/dt = uplift -
// hardness^-1 sqrt(A) dz/dx, A the drained area. uplift_m: [n] metres a time unit; softness: [n], about 1;
// is_outlet: [n] cells whose height stays. slope_limit: [n] tangents; nothing stands steeper than that over
// the cell it drains to. O(n log n) a step. (J. Braun, S. Willett, Geomorphology 180, 2013; G. Cordonnier et
// al., Large Scale Terrain Generation from Tectonic Uplift and Fluvial Erosion, Eurographics 2016, here with
// depressions routed by a flood and a pyramid of resolutions.)
void cut_rivers(Grid& height_m, const Grid& uplift_m, const Grid& softness, const Grid& slope_limit,
                const std::vector<uint8_t>& is_outlet, const Rivers& rivers);

// Lowers whatever stands steeper than slope_limit (tangents, [n] per cell, > 0) over any of its eight
// neighbours, and nothing else: afterwards z_i <= z_j + slope_limit_i * distance for all neighbours j. Makes
// no new pits. O(n) a sweep, few sweeps.
void fall_rock(Grid& height_m, const Grid& slope_limit);

// Evens out the ground: `passes` explicit steps of diffusion with `strength`[n] in 0..0.2. Borders stay.
void creep_soil(Grid& height_m, const Grid& strength, int passes);

// Widens valleys with more than least_area_m2 of drained area into troughs: floor half-width width_m * (A / 1
// km2)^(1/4), beyond it walls that steepen with the distance. Only lowers.
void widen_valleys(Grid& height_m, const std::vector<uint8_t>& is_outlet, double least_area_m2, double width_m);

// Raises every depression to the height at which it overflows: lakes. Returns how many cells it raised.
size_t fill_depressions(Grid& height_m, const std::vector<uint8_t>& is_outlet);

}  // namespace overlook::sample
