// The mesh while it is being simplified: half-edges as flat arrays by corner.
//
// Built and validated by OpenMesh (openmesh_topology.cpp); the hot loop then runs over these arrays, because a collapse through a
// general half-edge structure with handles, properties and status bits costs tens of microseconds, and here about one.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formats/caveclod.h"
#include "formats/result.h"
#include "tools/bake/caveclod/groups.h"
#include "tools/bake/mesh.h"

namespace overlook::caveclod {

constexpr uint32_t kNone = mesh::kNone;
constexpr uint32_t kMostValence = 32;  // of a position that is taken away, or that one is collapsed into

// Corners are written face * kCorners + 0, 1 or 2, counter-clockwise.
inline uint32_t next_corner(uint32_t corner) {
    return (corner & 3u) == 2 ? corner - 2 : corner + 1;
}
inline uint32_t previous_corner(uint32_t corner) {
    return (corner & 3u) == 0 ? corner + 2 : corner - 1;
}

// Positions and faces are numbered in a spatial order of its own (spatial_order.h).
struct WorkingMesh {
    std::vector<uint32_t> source_position, source_face;  // [P], [F] numbers in the mesh that it was made of
    std::vector<glm::vec3> positions_m;                  // [P]
    std::vector<uint32_t> position;                      // [4F] of each corner; those of faces that went stay as they were
    std::vector<uint32_t> vertex;                        // [4F] render vertex of each corner
    std::vector<uint32_t> opposite;                      // [4F] the corner across the edge that faces this one; kNone at borders
    std::vector<uint32_t> edge;                          // [4F] the edge that faces each corner
    std::vector<std::array<uint32_t, 2>> edge_corners;   // [E] the corners that an edge faces; the second kNone at borders
    std::vector<uint8_t> is_feature;                     // [E]
    std::vector<uint32_t> some_corner;                   // [P] one corner at each position; kNone when the position went
    std::vector<PositionKind> kind;                      // [P]
    std::vector<uint32_t> face_group;                    // [F]

    std::span<const RenderVertex> render_vertices;  // of the groups

    size_t face_count() const { return position.size() / kCorners; }
    bool is_alive(uint32_t p) const { return some_corner[p] != kNone; }
    glm::dvec3 at(uint32_t p) const { return glm::dvec3(positions_m[p]); }
};

// The faces round a position, counter-clockwise: face i is (position, link[i], link[i + 1]). Closed stars have link[count] ==
// link[0]; open ones begin and end at a border edge.
struct Star {
    uint32_t count = 0;
    bool is_closed = false;
    std::array<uint32_t, kMostValence> corner;  // of the position itself
    std::array<uint32_t, kMostValence + 1> link;
};

// False if there are more than kMostValence faces.
bool gather_star(const WorkingMesh& mesh, uint32_t position, Star& star);

// What a collapse of `gone` into `kept` changes: a star that begins, ends, or both, at `kept`. Faces first..last stay and turn
// their corner to `kept`; the others go.
struct Fan : Star {
    uint32_t gone = kNone, kept = kNone;
    uint32_t first = 0, last = 0;
    uint32_t nearest_staying(uint32_t face) const { return face < first ? first : face > last ? last : face; }
};
// star: of `gone`, with link[at] the position that stays. False if an open star would not be collapsed along its border.
bool fan_of(const Star& star, uint32_t gone, uint32_t at, Fan& fan);

// Makes the arrays. Fails with Exit::bad_input where the mesh is not what Mesh promises: "face 12 cannot be added: its edges have
// two faces already, or its faces do not form one fan at a corner".
Result<WorkingMesh> make_working_mesh(const mesh::Mesh& mesh, const Groups& groups);

// Takes `fan.gone` away. `vertex_at_kept`[i] is the render vertex of face i's turned corner. Writes only to what belongs to the
// fan's faces, to the sides of their neighbours that touch them, and to some_corner of the link.
void apply_collapse(WorkingMesh& mesh, const Fan& fan, std::span<const uint32_t> vertex_at_kept);

}  // namespace overlook::caveclod
