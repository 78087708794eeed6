// The seam to Draco.
#include <draco/compression/entropy/symbol_decoding.h>
#include <draco/compression/entropy/symbol_encoding.h>
#include <draco/core/bit_utils.h>

#include <algorithm>
#include <cassert>

#include "formats/little_endian.h"
#include "formats/value_codecs.h"

namespace overlook {

namespace {

// Draco counts how often each number stands in a row in a table as long as the greatest: it is given halves.
constexpr uint32_t kHalf = 16, kLow = (1u << kHalf) - 1;

bool append_packed(const std::vector<uint32_t>& halves, std::vector<std::byte>& bytes) {
    draco::EncoderBuffer buffer;
    if (!draco::EncodeSymbols(halves.data(), int(halves.size()), 1, nullptr, &buffer)) return false;
    auto packed = std::as_bytes(std::span(buffer.data(), buffer.size()));
    bytes.insert(bytes.end(), packed.begin(), packed.end());
    return true;
}

bool unpack(std::span<const std::byte> packed, std::span<uint32_t> halves) {
    if (packed.empty()) return false;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
    return draco::DecodeSymbols(uint32_t(halves.size()), 1, &buffer, halves.data()) && buffer.remaining_size() == 0 &&
           std::all_of(halves.begin(), halves.end(), [](uint32_t half) { return half <= kLow; });
}

}  // namespace

std::optional<std::vector<std::byte>> draco_packed(std::span<const uint32_t> values) {
    assert(!values.empty() && values.size() <= kMostChunkValues);
    std::vector<uint32_t> low, high;
    for (uint32_t value : values) low.push_back(value & kLow), high.push_back(value >> kHalf);
    std::vector<std::byte> bytes(4);
    if (!append_packed(low, bytes)) return std::nullopt;
    store_le<uint32_t>(bytes, 0, uint32_t(bytes.size() - 4));
    bool has_high = std::any_of(high.begin(), high.end(), [](uint32_t half) { return half != 0; });
    if (has_high && !append_packed(high, bytes)) return std::nullopt;
    return bytes;
}

bool draco_unpack(std::span<const std::byte> packed, std::span<uint32_t> values) {
    if (values.empty() || values.size() > kMostChunkValues || packed.size() < 4) return false;
    uint32_t low_bytes = load_le<uint32_t>(packed, 0);
    packed = packed.subspan(4);
    if (low_bytes > packed.size() || !unpack(packed.first(low_bytes), values)) return false;
    packed = packed.subspan(low_bytes);
    if (packed.empty()) return true;
    std::vector<uint32_t> high(values.size());
    if (!unpack(packed, high)) return false;
    for (size_t i = 0; i < values.size(); ++i) values[i] |= high[i] << kHalf;
    return std::any_of(high.begin(), high.end(), [](uint32_t half) { return half != 0; });
}

}  // namespace overlook
