// Random numbers that are the same on every machine: a sequence from a seed, and a number for a place.
//
// Based on: G. L. Steele, D. Lea, C. H. Flood, Fast Splittable Pseudorandom Number Generators, 2014 (SplitMix64).
#pragma once

#include <cstdint>

namespace overlook::wang_ldi {

// Every bit of `value` changes about half of those that come out; a bijection.
constexpr uint64_t mixed(uint64_t value) {
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
}

// Of a place: the same for the same seed, stream (what it is for) and place.
constexpr uint64_t hash_of(uint64_t seed, uint64_t stream, int64_t x, int64_t y) {
    constexpr uint64_t kStep = 0x9e3779b97f4a7c15u;
    uint64_t h = mixed(seed + kStep);
    h = mixed(h ^ (stream + kStep)), h = mixed((h + kStep) ^ uint64_t(x));
    return mixed((h + 3 * kStep) ^ uint64_t(y));
}

// 0 .. count - 1 from a hash; count: 1 or more.
constexpr uint32_t below(uint64_t hash, uint32_t count) {
    return uint32_t((hash >> 32) * count >> 32);
}

class Random {
  public:
    explicit Random(uint64_t seed) : state_(mixed(seed)) {}
    Random(uint64_t seed, uint64_t stream) : state_(hash_of(seed, stream, 0, 0)) {}

    uint64_t next() {
        state_ += 0x9e3779b97f4a7c15u;
        return mixed(state_);
    }
    uint32_t next_below(uint32_t count) { return below(next(), count); }
    double next_unit() { return double(next() >> 11) * 0x1p-53; }  // 0 <= it < 1

  private:
    uint64_t state_;
};

}  // namespace overlook::wang_ldi
