// The seams to the libraries that pack rows of numbers: each makes bytes of values and takes them back, bounded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace overlook {

// Values of a row at once; longer rows are cut into chunks.
constexpr size_t kMostChunkValues = 1 << 16;

// meshoptimizer's vertex codec over 1 .. kMostChunkValues values (A. Kapoulkine 2017): byte by byte, differences to the value
// before, which are taken beforehand so that the codec's own differences are the values. The same bytes on any machine.
std::vector<std::byte> meshopt_packed(std::span<const uint32_t> values);
// Fills `values` from exactly these bytes; false if they are not its. `packed` may be hostile.
bool meshopt_unpack(std::span<const std::byte> packed, std::span<uint32_t> values);

// The same codec over records of record_bytes (a multiple of 4, at most 256): records.size() is a multiple of it, above 0.
std::vector<std::byte> meshopt_packed_records(std::span<const std::byte> records, size_t record_bytes);
bool meshopt_unpack_records(std::span<const std::byte> packed, size_t record_bytes, std::span<std::byte> records);
// A record takes a byte at least for each so many of its bytes, so that a reader knows what a short row can hold.
constexpr size_t kRecordBytesPerPackedByte = 64;

// meshoptimizer's index codec over triangles: 3n indices below vertex_count, n > 0. They come back in their order, each with its
// corners perhaps turned round. What is unpacked may name any vertex.
std::vector<std::byte> meshopt_packed_triangles(std::span<const uint32_t> indices, size_t vertex_count);
bool meshopt_unpack_triangles(std::span<const std::byte> packed, std::span<uint32_t> indices);

// meshoptimizer's orders for what is drawn: equal records become one, the triangles of each run of indices go in an order that
// suits vertex caches, records in the order of their use; unused ones go. Returns how many records are left, which stand first.
// indices: 3n below the count of records; runs: one after the other, all of them.
struct IndexRun {
    uint32_t first = 0, count = 0;
};
size_t meshopt_order(std::span<std::byte> records, size_t record_bytes, std::span<uint32_t> indices,
                     std::span<const IndexRun> runs);

// Draco's symbol coding (rANS: J. Duda, 2013) over the same: the size of the low halves, those, and the
// high halves unless all are 0; nothing if Draco cannot.
std::optional<std::vector<std::byte>> draco_packed(std::span<const uint32_t> values);
bool draco_unpack(std::span<const std::byte> packed, std::span<uint32_t> values);

}  // namespace overlook
