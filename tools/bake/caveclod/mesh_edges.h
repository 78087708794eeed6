// Which faces meet across which edges of a triangle mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace overlook::caveclod {

using Corners = std::span<const std::array<uint32_t, 3>>;  // three a face

// Corner c of face f is written 3 f + c, and so is the edge that runs from it to the face's next corner.
inline uint32_t face_of(uint32_t corner) {
    return corner / 3;
}
inline uint32_t next_corner(uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}
inline uint32_t value_at(Corners corners, uint32_t corner) {
    return corners[corner / 3][corner % 3];
}

// twin: [3F] the edge of the face beyond, which runs the other way; kNoTwin where there is none: on borders, on edges of more
// than two faces, and where two faces run along an edge the same way. is_tangled: [3F] 1 where an edge has none though it has
// other faces.
constexpr uint32_t kNoTwin = 0xffffffff;
struct MeshEdges {
    std::vector<uint32_t> twin;
    std::vector<uint8_t> is_tangled;
};

// faces: [F] positions below position_count, no two corners of a face equal; F at most 2^32 / 3. O(F log d), d the greatest
// number of faces at a position.
MeshEdges edges_of(Corners faces, uint32_t position_count);

}  // namespace overlook::caveclod
