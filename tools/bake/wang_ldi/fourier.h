// Discrete Fourier transforms of pictures whose sides are powers of two.
//
// Based on: J. W. Cooley, J. W. Tukey, An Algorithm for the Machine Calculation of Complex Fourier Series, 1965.
#pragma once

#include <complex>
#include <cstdint>
#include <span>

namespace overlook::wang_ldi {

// In place, of [side, side] values, unscaled. side: a power of two. O(side^2 log side).
void fourier_2d(std::span<std::complex<double>> values, uint32_t side);

}  // namespace overlook::wang_ldi
