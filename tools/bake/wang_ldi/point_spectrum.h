// The spectrum of a set of points, by which distributions are judged: how much there is of each frequency, and how much that
// depends on direction.
//
// Based on: R. A. Ulichney, Digital Halftoning, 1987 (radial power, anisotropy); A. Lagae, P. Dutre, A Comparison of Methods for
// Generating Poisson Disk Distributions, 2008.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "formats/wang_tiles.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {

struct Points {
    double size_m = 0;  // of the square they lie in, from (0, 0)
    std::vector<std::pair<double, double>> places_m;
};
// All objects of a tiling's south-west square.
Points points_of(const Planting& planting, const Tiling& tiling);
// A Poisson disk set that nothing more has a place in, thrown at once over the whole square.
Points poisson_disk_points(double size_m, double radius_m, uint64_t seed);

struct PointSpectrum {
    double frequency_step = 0;         // cycles a metre, of a ring
    std::vector<double> radial_power;  // [rings]; 1 of points at random, far out
    std::vector<double>
        anisotropy_db;          // [rings]: variance within the ring over the square of its mean; 0 dB if no direction stands out
    double greatest_peak = 0;   // of any single frequency, over its ring's mean
    std::vector<double> power;  // [side, side], frequencies -side/2 .. side/2 of 1 / size_m, 0 in the middle
    uint32_t side = 0;
};
// Up to `most_frequency` cycles a metre, in `rings` rings. Points are put to a grid of 2048 x 2048 cells.
PointSpectrum spectrum_of(const Points& points, double most_frequency, uint32_t rings);

}  // namespace overlook::wang_ldi
