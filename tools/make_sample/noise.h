// Noise that is the same on every machine: integer hashes, additions and products, no library functions.
#pragma once

#include <cstdint>

namespace overlook::sample {

// A well-mixed 64-bit hash of three numbers.
uint64_t hash_of(uint64_t seed, uint64_t a, uint64_t b);

// The same as a number in [0, 1).
double unit_from_hash(uint64_t hash);

// Gradient noise, about -0.7..0.7, zero on whole numbers, one feature a unit (K. Perlin, Improving Noise,
// 2002; sixteen directions here, chosen by hash_of).
double gradient_noise(uint64_t seed, double x, double y);

// The same with a pattern that returns after `period` units, in x and in y.
double tiled_noise(uint64_t seed, double x, double y, uint32_t period);

// Sum of `octaves` of it, each twice as fine and half as high; about -1..1.
double fractal_noise(uint64_t seed, double x, double y, int octaves);

// Crests where the noise crosses zero, finer crests only near coarser ones; 0..about 1 (F. K. Musgrave,
// ridged multifractal, in Ebert et al., Texturing and Modeling, 1994).
double ridged_noise(uint64_t seed, double x, double y, int octaves);

// 0 below `from`, 1 above `to`, smooth between. from < to.
double smooth_step(double from, double to, double x);

}  // namespace overlook::sample
