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
// Of the number of a render vertex: its attributes, at another position than its own. Only where seams may move.
constexpr uint32_t kCarried = 0x80000000;

// Corners are written face * kCorners + 0, 1 or 2, counter-clockwise.
inline uint32_t next_corner(uint32_t corner) {
    return (corner & 3u) == 2 ? corner - 2 : corner + 1;
}
inline uint32_t previous_corner(uint32_t corner) {
    return (corner & 3u) == 0 ? corner + 2 : corner - 1;
}

// All that is known of a face, in one line of memory: walking round a position costs one for each face.
struct alignas(64) WorkingFace {
    std::array<uint32_t, 4> position;  // of each corner; the fourth is not used, here and below
    std::array<uint32_t, 4> vertex;    // render vertex of each corner
    std::array<uint32_t, 4> opposite;  // the corner across the edge that faces each one; kNone at borders
    std::array<uint32_t, 4> edge;      // the edge that faces each corner
};

// Positions and faces are numbered in a spatial order of its own (spatial_order.h).
struct WorkingMesh {
    std::vector<uint32_t> source_position, source_face;  // [P], [F] numbers in the mesh that it was made of
    std::vector<glm::vec3> positions_m;                  // [P]
    std::vector<WorkingFace> faces;                      // [F] those that went stay as they were
    std::vector<std::array<uint32_t, 2>> edge_corners;   // [E] the corners that an edge faces; the second kNone at borders
    std::vector<uint8_t> is_feature;                     // [E]
    std::vector<uint32_t> some_corner;                   // [P] one corner at each position; kNone when the position went
    std::vector<PositionKind> kind;                      // [P]
    std::vector<uint32_t> face_group;                    // [F]

    const Groups* groups = nullptr;      // what it was made of, which must outlive it
    bool seams_move = false;             // kind is then rigid or free
    std::vector<uint32_t> vertex_place;  // [D] if seams_move: the position here of each of the groups' render vertices

    const RenderVertex& look(uint32_t vertex) const { return groups->vertices[vertex & ~kCarried]; }
    size_t face_count() const { return faces.size(); }
    uint32_t& position(uint32_t corner) { return faces[corner / kCorners].position[corner % kCorners]; }
    uint32_t position(uint32_t corner) const { return faces[corner / kCorners].position[corner % kCorners]; }
    uint32_t& vertex(uint32_t corner) { return faces[corner / kCorners].vertex[corner % kCorners]; }
    uint32_t vertex(uint32_t corner) const { return faces[corner / kCorners].vertex[corner % kCorners]; }
    uint32_t& opposite(uint32_t corner) { return faces[corner / kCorners].opposite[corner % kCorners]; }
    uint32_t opposite(uint32_t corner) const { return faces[corner / kCorners].opposite[corner % kCorners]; }
    uint32_t& edge(uint32_t corner) { return faces[corner / kCorners].edge[corner % kCorners]; }
    uint32_t edge(uint32_t corner) const { return faces[corner / kCorners].edge[corner % kCorners]; }
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

// Makes the arrays. Fails with Exit::bad_input where the mesh is not what Mesh promises: "face 12 cannot be added: an edge of it
// has two faces already, or the faces at a corner are no fan", "position 7 is no corner of any face".
Result<WorkingMesh> make_working_mesh(const mesh::Mesh& mesh, const Groups& groups, bool seams_move = false);

// Takes `fan.gone` away. `vertex_at_kept`[i] is the render vertex of face i's turned corner. Writes only to what belongs to the
// fan's faces, to the sides of their neighbours that touch them, and to some_corner of the link.
void apply_collapse(WorkingMesh& mesh, const Fan& fan, std::span<const uint32_t> vertex_at_kept);

}  // namespace overlook::caveclod
