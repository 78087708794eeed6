// How evenly a planting covers the ground: across edges and corners as within.
//
// Based on: A. Lagae, P. Dutre, A Comparison of Methods for Generating Poisson Disk Distributions, 2008 (relative radius).
#pragma once

#include <vector>

#include "formats/wang_tiles.h"

namespace overlook::wang_ldi {

// Those tiles whose corners all have the greatest density; all, if there are none.
Planting fully_planted(const TileSet& set, const Planting& planting);

// Objects for their zone's area, over the mean of all zones; tiles as often as each other. `reach`: the greatest packing radius.
struct ZoneDensity {
    double corner = 1;  // middles within 3 reach of a corner
    double edge = 1;    // middles within 2 reach of an edge, and not in the corners' zones
    double inside = 1;  // the rest
};
ZoneDensity zone_density(const Planting& planting, double reach_m);

// 0 is even: how far densities by distance from the edge (8 steps of reach / 2) are from 1, root mean square, and, before all
// else, how far any zone is beyond 2 % from 1.
double unevenness_of(const TileSet& set, const Planting& planting, double reach_m);

// The same by distance from the nearest corner and from the nearest edge: [bins] of step_m each, density over the mean.
std::vector<double> density_by_corner_distance(const Planting& planting, double step_m, size_t bins);
std::vector<double> density_by_edge_distance(const Planting& planting, double step_m, size_t bins);

}  // namespace overlook::wang_ldi
