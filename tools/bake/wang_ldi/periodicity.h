// How far a tiling repeats itself, as numbers.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2002, figure 4, which shows it as pictures.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {

// Of tiles that stand (x, y) apart: how much more often than by chance both are the same, as a coefficient of correlation,
// (P(same) - sum p_t^2) / (1 - sum p_t^2), p_t the share of tile t in the tiling. 1: always the same; 0: as independent tiles.
struct Correlation {
    int x = 0, y = 0;
    double value = 0;
};

// The greatest in absolute value over all (x, y) with least <= max(|x|, |y|) <= most, each and its opposite once. The
// tiling is larger than `most` on both sides. Of independent tiles it is not 0 but about 3.5 / sqrt(columns * rows).
Correlation greatest_correlation(const Tiling& tiling, int least = 2, int most = 10);

// Power of the tiles' indicator functions, added up: spectrum[v][u] of frequency (u, v) / side, the mean left out (0 there),
// over the mean of all others: 1 everywhere for independent tiles. side: a power of two, no more than the tiling has columns and
// rows; its south-west square is looked at.
struct Spectrum {
    uint32_t side = 0;
    std::vector<double> power;  // [side, side]
};
Spectrum spectrum_of(const Tiling& tiling, size_t tile_count, uint32_t side);
// The greatest of a spectrum, and how much of all power stands in the hundredth of the frequencies that have most: 0.01 if it
// is the same everywhere, about 0.016 of independent tiles of 8 kinds, near 1 of what repeats.
struct SpectrumShape {
    double greatest = 0, share_of_top_hundredth = 0;
};
SpectrumShape shape_of(const Spectrum& spectrum);

}  // namespace overlook::wang_ldi
