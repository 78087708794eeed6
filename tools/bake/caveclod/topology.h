// Which faces of a mesh lie beside one another.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "formats/caveclod.h"
#include "tools/bake/mesh.h"

namespace overlook::caveclod {

constexpr uint32_t kNobody = 0xffffffff;

struct Topology {
    std::vector<uint32_t> edge;                         // [4F] the edge that faces each corner (face * kCorners + 0, 1 or 2)
    std::vector<uint32_t> opposite;                     // [4F] the corner on its other side; kNobody at borders
    std::vector<std::array<uint32_t, 2>> edge_corners;  // [E] the corners that an edge faces; the second kNobody at borders
};

// The first face that could not be added, and why: "cannot be added: ...".
struct NoSurface {
    uint32_t face = 0;
    std::string why;
};

// faces: [F], ids below position_count, no face with two equal. Edges are numbered as OpenMesh does, in the order in which the
// faces bring them. O(F). Fails where an edge would have three faces or two that run along it the same way, or where the faces at
// a position are no fan.
tl::expected<Topology, NoSurface> find_topology(size_t position_count, std::span<const mesh::Corners> faces);

}  // namespace overlook::caveclod
