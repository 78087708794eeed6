#include "tools/make_sample/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace overlook::sample {
namespace {

// cos and sin of 0, 22.5, 45 ... degrees.
constexpr double kC1 = 0.9238795325112867, kC2 = 0.7071067811865476, kC3 = 0.3826834323650898;
constexpr std::array<std::array<double, 2>, 16> kDirections = {{{1, 0},
                                                                {kC1, kC3},
                                                                {kC2, kC2},
                                                                {kC3, kC1},
                                                                {0, 1},
                                                                {-kC3, kC1},
                                                                {-kC2, kC2},
                                                                {-kC1, kC3},
                                                                {-1, 0},
                                                                {-kC1, -kC3},
                                                                {-kC2, -kC2},
                                                                {-kC3, -kC1},
                                                                {0, -1},
                                                                {kC3, -kC1},
                                                                {kC2, -kC2},
                                                                {kC1, -kC3}}};

uint64_t mix(uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

double corner(uint64_t seed, int64_t column, int64_t row, double dx, double dy) {
    const auto& direction = kDirections[hash_of(seed, uint64_t(column), uint64_t(row)) >> 60];
    return direction[0] * dx + direction[1] * dy;
}

double fade(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

// `fold` says which place of the pattern a place of the plane shows.
template <class Fold>
double noise_at(uint64_t seed, double x, double y, const Fold& fold) {
    double column = std::floor(x), row = std::floor(y);
    double dx = x - column, dy = y - row;
    int64_t left = fold(int64_t(column)), right = fold(int64_t(column) + 1), above = fold(int64_t(row)),
            below = fold(int64_t(row) + 1);
    double sx = fade(dx), sy = fade(dy);

    double top = corner(seed, left, above, dx, dy);
    top += sx * (corner(seed, right, above, dx - 1, dy) - top);
    double bottom = corner(seed, left, below, dx, dy - 1);
    bottom += sx * (corner(seed, right, below, dx - 1, dy - 1) - bottom);
    return top + sy * (bottom - top);
}

}  // namespace

uint64_t hash_of(uint64_t seed, uint64_t a, uint64_t b) {
    return mix(mix(mix(seed + 0x9e3779b97f4a7c15u) + a * 0xd1342543de82ef95u) + b * 0x2545f4914f6cdd1du);
}

double unit_from_hash(uint64_t hash) {
    return double(hash >> 11) * 0x1p-53;
}

double gradient_noise(uint64_t seed, double x, double y) {
    return noise_at(seed, x, y, [](int64_t i) { return i; });
}

double tiled_noise(uint64_t seed, double x, double y, uint32_t period) {
    int64_t n = period;
    return noise_at(seed, x, y, [n](int64_t i) { return (i % n + n) % n; });
}

double fractal_noise(uint64_t seed, double x, double y, int octaves) {
    double sum = 0, amplitude = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += amplitude * gradient_noise(seed + uint64_t(octave), x, y);
        amplitude *= 0.5;
        x = 2 * x + 17.3;
        y = 2 * y - 9.1;
    }
    return sum;
}

double ridged_noise(uint64_t seed, double x, double y, int octaves) {
    double sum = 0, amplitude = 0.5, weight = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        double crest = 1 - std::min(1.0, 1.6 * std::abs(gradient_noise(seed + uint64_t(octave), x, y)));
        crest *= crest * weight;
        sum += amplitude * crest;
        weight = std::clamp(crest * 2, 0.0, 1.0);
        amplitude *= 0.5;
        x = 2 * x + 31.7;
        y = 2 * y + 5.9;
    }
    return sum;
}

double smooth_step(double from, double to, double x) {
    double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace overlook::sample
