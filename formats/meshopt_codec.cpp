// The seam to meshoptimizer.
#include <meshoptimizer.h>

#include <array>
#include <cassert>

#include "formats/little_endian.h"
#include "formats/value_codecs.h"

namespace overlook {
namespace {

// The codec stores each byte's difference to that of the element before, small ones either way in few bits (zigzag). A value's
// byte b goes in as the sum of all before: the difference that the codec takes is b itself, made signed so that small values stay
// small.
uint8_t folded(uint8_t byte) {  // 0 1 2 3 .. -> 0 -1 1 -2 ..
    return uint8_t((byte & 1) != 0 ? ~(byte >> 1) : byte >> 1);
}
uint8_t unfolded(uint8_t byte) {
    return uint8_t((byte & 0x80) != 0 ? (uint8_t(~byte) << 1) | 1 : byte << 1);
}

}  // namespace

std::vector<std::byte> meshopt_packed(std::span<const uint32_t> values) {
    assert(!values.empty() && values.size() <= kMostChunkValues);
    std::vector<std::byte> sums(values.size() * 4);
    std::array<uint8_t, 4> sum{};
    for (size_t i = 0; i < values.size(); ++i) {
        for (size_t byte = 0; byte < 4; ++byte) {
            sum[byte] = uint8_t(sum[byte] + folded(uint8_t(values[i] >> (8 * byte))));
            sums[4 * i + byte] = std::byte(sum[byte]);
        }
    }
    std::vector<std::byte> packed(meshopt_encodeVertexBufferBound(values.size(), 4));
    packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), sums.data(),
                                             values.size(), 4));
    return packed;
}

bool meshopt_unpack(std::span<const std::byte> packed, std::span<uint32_t> values) {
    if (values.empty() || values.size() > kMostChunkValues || packed.empty()) return false;
    std::vector<std::byte> sums(values.size() * 4);
    if (meshopt_decodeVertexBuffer(sums.data(), values.size(), 4, reinterpret_cast<const unsigned char*>(packed.data()),
                                   packed.size()) != 0)
        return false;
    std::array<uint8_t, 4> sum{};
    for (size_t i = 0; i < values.size(); ++i) {
        uint32_t value = 0;
        for (size_t byte = 0; byte < 4; ++byte) {
            uint8_t now = uint8_t(sums[4 * i + byte]);
            value |= uint32_t(unfolded(uint8_t(now - sum[byte]))) << (8 * byte);
            sum[byte] = now;
        }
        values[i] = value;
    }
    return true;
}

// The versions that the formats' documents name, whatever the library's newest are.
static void pin_versions() {
    [[maybe_unused]] static const bool is_pinned = (meshopt_encodeVertexVersion(0), meshopt_encodeIndexVersion(0), true);
}

std::vector<std::byte> meshopt_packed_records(std::span<const std::byte> records, size_t record_bytes) {
    pin_versions();
    assert(!records.empty() && record_bytes % 4 == 0 && record_bytes <= 256 && records.size() % record_bytes == 0);
    size_t count = records.size() / record_bytes;
    std::vector<std::byte> packed(meshopt_encodeVertexBufferBound(count, record_bytes));
    packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), records.data(),
                                             count, record_bytes));
    return packed;
}

bool meshopt_unpack_records(std::span<const std::byte> packed, size_t record_bytes, std::span<std::byte> records) {
    if (records.empty() || packed.empty()) return false;
    return meshopt_decodeVertexBuffer(records.data(), records.size() / record_bytes, record_bytes,
                                      reinterpret_cast<const unsigned char*>(packed.data()), packed.size()) == 0;
}

std::vector<std::byte> meshopt_packed_triangles(std::span<const uint32_t> indices, size_t vertex_count) {
    pin_versions();
    assert(!indices.empty() && indices.size() % 3 == 0);
    std::vector<std::byte> packed(meshopt_encodeIndexBufferBound(indices.size(), vertex_count));
    packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), indices.data(),
                                            indices.size()));
    return packed;
}

bool meshopt_unpack_triangles(std::span<const std::byte> packed, std::span<uint32_t> indices) {
    if (indices.empty() || indices.size() % 3 != 0 || packed.empty()) return false;
    return meshopt_decodeIndexBuffer(indices.data(), indices.size(), sizeof(uint32_t),
                                     reinterpret_cast<const unsigned char*>(packed.data()), packed.size()) == 0;
}

size_t meshopt_order(std::span<std::byte> records, size_t record_bytes, std::span<uint32_t> indices,
                     std::span<const IndexRun> runs) {
    size_t count = records.size() / record_bytes;
    std::vector<uint32_t> remap(count);
    count = meshopt_generateVertexRemap(remap.data(), indices.data(), indices.size(), records.data(), count, record_bytes);
    std::vector<std::byte> welded(count * record_bytes);
    meshopt_remapVertexBuffer(welded.data(), records.data(), remap.size(), record_bytes, remap.data());
    meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), remap.data());
    for (const IndexRun& run : runs)
        meshopt_optimizeVertexCache(indices.data() + run.first, indices.data() + run.first, run.count, count);
    return meshopt_optimizeVertexFetch(records.data(), indices.data(), indices.size(), welded.data(), count, record_bytes);
}

}  // namespace overlook
