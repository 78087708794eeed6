// Sines, powers and their like that are the same on every processor and of every compiler, to the last bit: made of sums,
// products, quotients and square roots alone, which IEEE 754 says exactly. The C library's are not: it has several of each, and
// takes those that suit the processor. For all that decides the bytes of a file. Errors are a few units of the last place.
#pragma once

namespace overlook::steady {

struct SinCos {
    double sin = 0, cos = 1;
};
// angle_rad: beyond 1e6 to either side taken less whole turns, inexactly; not finite: NaN.
SinCos sin_cos(double angle_rad);
double sin(double angle_rad);
double cos(double angle_rad);
double tan(double angle_rad);
// value > 0, finite.
double log2(double value);
// exponent: -1000 to 1000.
double exp2(double exponent);
// base >= 0 (0: 0), finite; base^exponent: as exp2().
double pow(double base, double exponent);

}  // namespace overlook::steady
