#include "formats/steady_math.h"

#include <cmath>

namespace overlook::steady {
namespace {

// Half of pi, the first 33 bits and the rest: whole multiples of the first part are exact.
constexpr double kHalfPi = 1.57079632673412561417, kHalfPiRest = 6.0771005065061922e-11;
constexpr double kLn2 = 0.69314718055994530942;

// Taylor's series about 0, within a quarter of pi.
SinCos within_a_quarter(double x) {
    double square = x * x, sine = 0, cosine = 0;
    // 1 / (2 * 3), 1 / (4 * 5) ... and 1 / (1 * 2), 1 / (3 * 4) ...: the last terms are beyond the last place.
    for (int n = 17; n >= 3; n -= 2) sine = (1 - sine) * square / (n * (n - 1));
    for (int n = 18; n >= 2; n -= 2) cosine = (1 - cosine) * square / (n * (n - 1));
    return {x - x * sine, 1 - cosine};
}

}  // namespace

SinCos sin_cos(double angle_rad) {
    constexpr double kMost = 1e6;
    if (!std::isfinite(angle_rad)) return {NAN, NAN};
    if (std::abs(angle_rad) > kMost) angle_rad = std::remainder(angle_rad, 2 * 3.14159265358979323846);
    double turns = std::floor(angle_rad * (2 / 3.14159265358979323846) + 0.5);
    SinCos at = within_a_quarter((angle_rad - turns * kHalfPi) - turns * kHalfPiRest);
    switch (static_cast<long>(turns) & 3) {
        case 0:
            return at;
        case 1:
            return {at.cos, -at.sin};
        case 2:
            return {-at.sin, -at.cos};
        default:
            return {-at.cos, at.sin};
    }
}

double sin(double angle_rad) {
    return sin_cos(angle_rad).sin;
}
double cos(double angle_rad) {
    return sin_cos(angle_rad).cos;
}
double tan(double angle_rad) {
    SinCos at = sin_cos(angle_rad);
    return at.sin / at.cos;
}

// value = m 2^e, m about 1; ln m = 2 artanh((m - 1) / (m + 1)), as a series.
double log2(double value) {
    int exponent = 0;
    double m = std::frexp(value, &exponent);
    if (m < 0.70710678118654752440) m *= 2, --exponent;
    double s = (m - 1) / (m + 1), square = s * s, sum = 0;
    for (int n = 23; n >= 3; n -= 2) sum = (sum + 1.0 / n) * square;
    return exponent + 2 * (s + s * sum) / kLn2;
}

double exp2(double exponent) {
    double whole = std::floor(exponent + 0.5), x = (exponent - whole) * kLn2, sum = 1;
    for (int n = 16; n >= 1; --n) sum = 1 + x * sum / n;
    return std::ldexp(sum, int(whole));
}

double pow(double base, double exponent) {
    return base > 0 ? exp2(exponent * log2(base)) : 0;
}

}  // namespace overlook::steady
