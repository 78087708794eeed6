// The chunks of a PNG file. Source: W3C, "Portable Network Graphics (PNG) Specification", 2003, sections 5 and annex D.

#include "tools/bake/png_check.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace overlook {
namespace {

constexpr std::array<uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr uint32_t kHeaderName = 0x49484452, kEndName = 0x49454e44;  // IHDR, IEND
constexpr uint32_t kHeaderBytes = 13;
constexpr uint64_t kChunkFrameBytes = 12;  // length, name, checksum

constexpr std::array<uint32_t, 256> make_crc_table() {
    std::array<uint32_t, 256> table{};
    for (uint32_t n = 0; n < 256; ++n) {
        uint32_t c = n;
        for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
        table[n] = c;
    }
    return table;
}
constexpr std::array<uint32_t, 256> kCrcTable = make_crc_table();

uint32_t crc_32(std::span<const std::byte> bytes) {
    uint32_t crc = 0xffffffff;
    for (const std::byte b : bytes) crc = kCrcTable[(crc ^ std::to_integer<uint32_t>(b)) & 255] ^ (crc >> 8);
    return ~crc;
}

uint32_t big_endian_32(std::span<const std::byte> bytes, uint64_t at) {
    uint32_t value = 0;
    for (uint64_t i = 0; i < 4; ++i) value = value << 8 | std::to_integer<uint32_t>(bytes[size_t(at + i)]);
    return value;
}

}  // namespace

bool is_png(std::span<const std::byte> bytes) {
    return bytes.size() >= kSignature.size() && std::equal(kSignature.begin(), kSignature.end(), bytes.begin(),
                                                           [](uint8_t a, std::byte b) { return std::byte(a) == b; });
}

Result<void> check_png(std::span<const std::byte> bytes, const std::string& name) {
    if (!is_png(bytes)) return bad_input("{}: is not a PNG file", name);
    for (uint64_t at = kSignature.size();;) {
        const uint64_t left = bytes.size() - at;
        const uint64_t length = left >= kChunkFrameBytes ? big_endian_32(bytes, at) : 0;
        if (left < kChunkFrameBytes || length > left - kChunkFrameBytes)
            return bad_input("{}: PNG chunk at byte {} ends after the file, which is {} bytes long; was the copy cut short?",
                             name, at, bytes.size());
        const uint32_t kind = big_endian_32(bytes, at + 4);
        if (at == kSignature.size() && (kind != kHeaderName || length != kHeaderBytes))
            return bad_input("{}: its first PNG chunk is no header (IHDR)", name);
        if (crc_32(bytes.subspan(size_t(at + 4), size_t(length + 4))) != big_endian_32(bytes, at + 8 + length))
            return bad_input("{}: PNG chunk at byte {} is damaged: its checksum does not match", name, at);
        if (kind == kEndName) return {};
        at += kChunkFrameBytes + length;
    }
}

}  // namespace overlook
