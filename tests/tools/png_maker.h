// A PNG file without compression, so that a test can make any.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

namespace overlook::test {

inline std::string big_endian_32(uint32_t value) {
    return {char(value >> 24), char(value >> 16 & 255), char(value >> 8 & 255), char(value & 255)};
}

// A chunk with its CRC-32 (W3C, PNG specification, annex D).
inline std::string png_chunk(const std::string& name, const std::string& data) {
    const std::string body = name + data;
    uint32_t crc = 0xffffffff;
    for (const char c : body) {
        crc ^= uint8_t(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320 ^ crc >> 1 : crc >> 1;
    }
    return big_endian_32(uint32_t(data.size())) + body + big_endian_32(~crc);
}

// rows: the samples as PNG has them (big-endian, packed), bytes_per_row each. `extra` chunks stand before the samples.
inline std::string make_png(uint32_t width, uint32_t height, int bit_depth, int colour_type, const std::string& rows,
                            const std::string& extra = "") {
    const size_t bytes_per_row = rows.size() / height;
    std::string raw;
    for (uint32_t y = 0; y < height; ++y) raw += std::string(1, '\0') + rows.substr(y * bytes_per_row, bytes_per_row);

    std::string stream = "\x78\x01";
    for (size_t at = 0; at < raw.size(); at += 65535) {  // stored blocks of RFC 1951
        const size_t size = std::min<size_t>(65535, raw.size() - at);
        stream += char(at + size == raw.size());
        stream += {char(size & 255), char(size >> 8), char(~size & 255), char(~size >> 8 & 255)};
        stream += raw.substr(at, size);
    }
    uint32_t a = 1, b = 0;
    for (const char c : raw) {
        a = (a + uint8_t(c)) % 65521;
        b = (b + a) % 65521;
    }
    stream += big_endian_32(b << 16 | a);

    const std::string header =
        big_endian_32(width) + big_endian_32(height) + std::string{char(bit_depth), char(colour_type), 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + extra + png_chunk("IDAT", stream) + png_chunk("IEND", "");
}

}  // namespace overlook::test
