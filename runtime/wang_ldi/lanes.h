// Eight numbers at a time, for inner loops that are compiled several times, with and without wider vectors. Included by what is
// included once by each of those compilations: so nothing in here may have a name that others see, nor call what others compile.
#pragma once

#include <cstdint>

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kLanes = 8;
using Floats = float __attribute__((vector_size(32)));
using Ints = int32_t __attribute__((vector_size(32)));
using Words = uint32_t __attribute__((vector_size(32)));
using Shorts = uint16_t __attribute__((vector_size(16)));
using Bytes = uint8_t __attribute__((vector_size(8)));

template <class Vector, class Number>
inline void load(Vector& into, const Number* from) {
    __builtin_memcpy(&into, from, sizeof into);
}
template <class Vector, class Number>
inline void store(Number* to, const Vector& from) {
    __builtin_memcpy(to, &from, sizeof from);
}
// Lanes of one where the mask has all bits, of the other where it has none.
template <class Vector>
inline Vector chosen(const Ints& mask, const Vector& one, const Vector& other) {
    return (Vector)(((Ints)one & mask) | ((Ints)other & ~mask));
}
inline Ints floor_of(const Floats& value) {
    Ints towards_zero = __builtin_convertvector(value, Ints);
    return towards_zero + (__builtin_convertvector(towards_zero, Floats) > value);
}
inline Ints lesser(const Ints& a, const Ints& b) {
    return chosen(a < b, a, b);
}
inline Ints greater(const Ints& a, const Ints& b) {
    return chosen(a > b, a, b);
}
// Of the first `count` lanes, 1 or more; the others are as the first.
template <class Vector, class Number>
inline void load(Vector& into, const Number* from, uint32_t count) {
    if (count >= kLanes) return load(into, from);
    for (uint32_t lane = 0; lane < kLanes; ++lane) into[lane] = from[lane < count ? lane : 0];
}
template <class Vector, class Number>
inline void store(Number* to, const Vector& from, uint32_t count) {
    if (count >= kLanes) return store(to, from);
    for (uint32_t lane = 0; lane < count; ++lane) to[lane] = from[lane];
}

}  // namespace
}  // namespace overlook::wang_ldi
