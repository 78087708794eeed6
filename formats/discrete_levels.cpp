// A level's vertices, triangles and draws as bytes, and back.
#include "formats/discrete_layout.h"
#include "formats/value_codecs.h"

namespace overlook::discrete {
namespace {

constexpr size_t kVertexBytes = sizeof(Vertex);

void store_vertex(std::span<std::byte> to, const Vertex& vertex) {
    for (size_t i = 0; i < 3; ++i) store_le<uint16_t>(to, 2 * i, vertex.position[i]);
    store_le<uint16_t>(to, 6, vertex.part);
    for (size_t i = 0; i < 2; ++i) store_le<uint16_t>(to, 8 + 2 * i, uint16_t(vertex.normal[i]));
    for (size_t i = 0; i < 2; ++i) store_le<uint16_t>(to, 12 + 2 * i, vertex.uv[i]);
    for (size_t i = 0; i < 4; ++i) to[16 + i] = std::byte(vertex.colour[i]);
}

Vertex vertex_at(std::span<const std::byte> from) {
    Vertex vertex;
    for (size_t i = 0; i < 3; ++i) vertex.position[i] = load_le<uint16_t>(from, 2 * i);
    vertex.part = load_le<uint16_t>(from, 6);
    for (size_t i = 0; i < 2; ++i) vertex.normal[i] = int16_t(load_le<uint16_t>(from, 8 + 2 * i));
    for (size_t i = 0; i < 2; ++i) vertex.uv[i] = load_le<uint16_t>(from, 12 + 2 * i);
    for (size_t i = 0; i < 4; ++i) vertex.colour[i] = uint8_t(from[16 + i]);
    return vertex;
}

}  // namespace

std::vector<std::byte> bytes_of_level(const Level& level, LevelSize& size) {
    std::vector<std::byte> records(level.vertices.size() * kVertexBytes);
    for (size_t v = 0; v < level.vertices.size(); ++v)
        store_vertex(std::span(records).subspan(v * kVertexBytes, kVertexBytes), level.vertices[v]);
    std::vector<std::byte> bytes = meshopt_packed_records(records, kVertexBytes);
    std::vector<std::byte> triangles = meshopt_packed_triangles(level.indices, level.vertices.size());
    size = {uint32_t(level.vertices.size()), uint32_t(level.indices.size()), uint32_t(level.draws.size()), uint32_t(bytes.size()),
            uint32_t(triangles.size())};
    bytes.insert(bytes.end(), triangles.begin(), triangles.end());
    for (const Draw& draw : level.draws) {
        bytes.resize(bytes.size() + kDrawBytes);
        store_le<uint32_t>(bytes, bytes.size() - 8, draw.surface), store_le<uint32_t>(bytes, bytes.size() - 4, draw.index_count);
    }
    return bytes;
}

Fault level_of_bytes(std::span<const std::byte> bytes, const LevelSize& size, uint32_t part_count, uint32_t surface_count,
                     Level& level) {
    std::vector<std::byte> records(size_t(size.vertices) * kVertexBytes);
    if (!meshopt_unpack_records(bytes.first(size.vertex_bytes), kVertexBytes, records))
        return {10, fmt::format("{} bytes do not decode to {} vertices", size.vertex_bytes, size.vertices)};
    level.vertices.reserve(size.vertices);
    for (size_t v = 0; v < size.vertices; ++v)
        level.vertices.push_back(vertex_at(std::span<const std::byte>(records).subspan(v * kVertexBytes, kVertexBytes)));

    level.indices.resize(size.indices);
    if (!meshopt_unpack_triangles(bytes.subspan(size.vertex_bytes, size.index_bytes), level.indices))
        return {10, fmt::format("{} bytes do not decode to {} indices", size.index_bytes, size.indices)};
    if (Fault fault = fault_of_level(level, part_count)) return fault;

    uint64_t next = 0;
    std::span<const std::byte> draws = bytes.subspan(size_t(size.vertex_bytes) + size.index_bytes);
    for (size_t d = 0; d < size.draws; ++d) {
        auto count = load_le<uint32_t>(draws, kDrawBytes * d + 4);
        if (next + count > size.indices)
            return {13, fmt::format("draw {} has {} indices, {} of {} are before it", d, count, next, size.indices)};
        level.draws.push_back({load_le<uint32_t>(draws, kDrawBytes * d), uint32_t(next), count});
        next += count;
    }
    return fault_of_draws(level, surface_count);
}

}  // namespace overlook::discrete
