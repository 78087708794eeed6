// The seam to Draco.
#include <draco/compression/entropy/symbol_decoding.h>
#include <draco/compression/entropy/symbol_encoding.h>
#include <draco/core/bit_utils.h>

#include <algorithm>
#include <cassert>

#include "formats/value_codecs.h"

namespace overlook {

std::optional<std::vector<std::byte>> draco_packed(std::span<const uint32_t> values) {
    assert(!values.empty() && values.size() <= kMostChunkValues);
    // Draco counts numbers by their bits in a table that has no room for 32 of them.
    if (std::any_of(values.begin(), values.end(), [](uint32_t value) { return value >> 31 != 0; })) return std::nullopt;
    draco::EncoderBuffer buffer;
    if (!draco::EncodeSymbols(values.data(), int(values.size()), 1, nullptr, &buffer)) return std::nullopt;
    auto bytes = std::as_bytes(std::span(buffer.data(), buffer.size()));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
}

bool draco_unpack(std::span<const std::byte> packed, std::span<uint32_t> values) {
    if (values.empty() || values.size() > kMostChunkValues || packed.empty()) return false;
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
    buffer.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
    return draco::DecodeSymbols(uint32_t(values.size()), 1, &buffer, values.data()) && buffer.remaining_size() == 0;
}

}  // namespace overlook
