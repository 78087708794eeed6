#include "runtime/discrete/visibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace overlook::discrete {
namespace {

// SplitMix64 (Steele, Lea, Flood 2014): the same numbers everywhere.
uint64_t next_random(uint64_t& state) {
    uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

uint32_t wrapped(double turns, uint32_t count) {
    double part = turns - std::floor(turns);
    return std::min(uint32_t(part * count), count - 1);
}

uint32_t clamped(double share, uint32_t count) {
    return uint32_t(std::clamp(std::floor(share * count), 0.0, double(count - 1)));
}

}  // namespace

Visibility uniform_noise(double period_m) {
    Visibility noise;
    noise.width = noise.height = kNoiseSide;
    noise.depth = 1;
    noise.period_m = float(period_m);
    noise.values.resize(size_t(kNoiseSide) * kNoiseSide);
    for (size_t i = 0; i < noise.values.size(); ++i) noise.values[i] = uint8_t(i % 256);
    uint64_t state = 2008;
    for (size_t i = noise.values.size() - 1; i > 0; --i) std::swap(noise.values[i], noise.values[next_random(state) % (i + 1)]);
    return noise;
}

std::vector<Visibility> visibilities_of(const Chain& chain) {
    size_t count = std::max<size_t>(chain.levels.size(), 2) - 1;
    if (chain.visibility.size() == count) return chain.visibility;
    Visibility one = chain.visibility.empty() ? uniform_noise(chain.radius_m > 0 ? chain.radius_m : 1) : chain.visibility.front();
    return std::vector<Visibility>(count, one);
}

double visibility_at(const Visibility& visibility, const glm::dvec3& at_m, const glm::dvec3& from_origin_m, double grain) {
    double period_m = double(visibility.period_m);
    uint32_t column = 0, row = 0, slice = 0;
    if (visibility.lookup == Visibility::Lookup::paper) {
        column = wrapped((at_m.x + at_m.z) / (period_m * grain), visibility.width);
        row = wrapped((at_m.y + at_m.z) / (period_m * grain), visibility.height);
    } else {
        column = clamped(from_origin_m.x / period_m, visibility.width);
        row = clamped(from_origin_m.y / period_m, visibility.height);
        slice = clamped(from_origin_m.z / period_m, visibility.depth);
    }
    size_t at = (size_t(slice) * visibility.height + row) * visibility.width + column;
    return visibility.values[at] / 255.0;
}

}  // namespace overlook::discrete
