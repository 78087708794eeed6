// Numbers in files: little-endian on every machine, at any alignment.
#pragma once

#include <bit>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace overlook {

// The unsigned number whose sizeof(T) bytes stand at `offset`. The caller has checked that they lie within `bytes`.
template <std::unsigned_integral T>
T load_le(std::span<const std::byte> bytes, size_t offset) {
    assert(offset <= bytes.size() && sizeof(T) <= bytes.size() - offset);
    T value = 0;
    for (size_t i = 0; i < sizeof(T); i++) value = T(value | T(T(bytes[offset + i]) << (8 * i)));
    return value;
}

template <std::unsigned_integral T>
void store_le(std::span<std::byte> bytes, size_t offset, T value) {
    assert(offset <= bytes.size() && sizeof(T) <= bytes.size() - offset);
    for (size_t i = 0; i < sizeof(T); i++) bytes[offset + i] = std::byte((value >> (8 * i)) & 0xff);
}

// IEEE 754, the same way.
inline void store_f64(std::span<std::byte> bytes, size_t offset, double value) {
    store_le<uint64_t>(bytes, offset, std::bit_cast<uint64_t>(value));
}
inline void store_f32(std::span<std::byte> bytes, size_t offset, float value) {
    store_le<uint32_t>(bytes, offset, std::bit_cast<uint32_t>(value));
}
inline double load_f64(std::span<const std::byte> bytes, size_t offset) {
    return std::bit_cast<double>(load_le<uint64_t>(bytes, offset));
}
inline float load_f32(std::span<const std::byte> bytes, size_t offset) {
    return std::bit_cast<float>(load_le<uint32_t>(bytes, offset));
}

}  // namespace overlook
