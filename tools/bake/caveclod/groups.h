// Surface groups of a mesh, the class of each of its positions, its render vertices, and how few ids the groups need.
// B. Kram, C. Shaw, Multiple Camera Considerations in a View-Dependent Continuous Level of Detail Algorithm, 2002, 3.1 and 3.3.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "formats/caveclod.h"
#include "formats/result.h"
#include "tools/bake/mesh.h"

namespace overlook::caveclod {

// FREE, SHARP and RIGID of the paper.
//   free   on no boundary: inside a surface group, its faces a closed ring. May float or stay.
//   sharp  on exactly one boundary curve: exactly two feature edges meet there. May float, but only along one of the two.
//   rigid  anything else, which must stay: where boundaries meet or end (the tip of a dart), positions cut apart by repair
//          (Mesh::link), positions where the surface touches itself in one point, edges of more than two faces, and positions
//          without any face.
enum class PositionKind : uint8_t { free, sharp, rigid };

// Why an edge is a feature.
//   border   fewer or more than two faces, or two that run along it the same way: nothing may be drawn across it
//   between  a surface group on the left, another on the right
//   seam     the same group on both sides, which touches itself: the unwrap of a cylinder, a dart
enum class FeatureKind : uint8_t { border, between, seam };

struct FeatureEdge {
    uint32_t a = 0, b = 0;  // positions, a < b
    FeatureKind kind = FeatureKind::border;
};

struct GroupOptions {
    // Where the file has no normals of its own: normals are made, smooth over edges that the surface turns at by at most this.
    // 0..180; 180 = smooth everywhere.
    double crease_deg = 180;
    // Corners beside one another whose normals differ by at most this share their mean, where no corner's own is turned by more
    // than this; 0..90, 0 = only equal ones are one.
    double weld_normals_deg = 0;
    bool ignores_uv = false;  // texture coordinates are left out, as if the file had none
};

struct Groups {
    std::vector<uint32_t> face_group;     // [F] numbered in the order of their first faces
    std::vector<uint32_t> group_surface;  // [G]
    std::vector<uint16_t> group_packed;   // [G] 0..packed_count-1, differs for any two groups that share a position
    uint32_t packed_count = 0;
    uint32_t clique_bound = 0;  // that many groups share a position pairwise: fewer ids cannot do

    std::vector<PositionKind> kind;     // [P]
    std::vector<uint8_t> is_fixed;      // [P] rigid for a reason that no seam budget lifts: any but where boundaries meet or end
    std::vector<FeatureEdge> features;  // sorted by a, then b, each edge once
    std::vector<uint32_t> feature_begin;  // [P+1] rows over `feature_ends`
    std::vector<uint32_t> feature_ends;   // the other ends of the feature edges at each position, ascending

    // One for each fan of corners beside one another at a position, of one group and with equal attributes, so that a group that
    // touches itself across a seam keeps all of them. Sorted by position, then by the fan's first corner in the mesh.
    std::vector<RenderVertex> vertices;                  // [D]
    std::vector<uint32_t> vertex_group;                  // [D]
    std::vector<glm::vec2> vertex_uv2;                   // [D] or empty: the second texture coordinates
    std::vector<uint32_t> vertex_begin;                  // [P+1] rows over `vertices`
    std::vector<std::array<uint32_t, 3>> face_vertices;  // [F] render vertex of each corner

    // The index array of the paper, packed_count x P, against the rows that stand for it: 32-bit entries both.
    double dense_population = 0;   // share of its entries in use
    uint64_t dense_bytes = 0;      // 4 * packed_count * P
    uint64_t rows_bytes = 0;       // 4 * (P + 1) offsets and 4 * D groups
    uint32_t most_vertices = 0;    // at one position
    uint64_t ambiguous_count = 0;  // positions where some group has more than one vertex: one entry of the array does not do

    uint64_t free_count = 0, sharp_count = 0, rigid_count = 0;
    uint64_t fixed_face_count = 0;     // faces whose three corners are rigid: none of them ever goes under the strict rule
    uint64_t floor_face_estimate = 0;  // so many faces stay at least, topology kept: see least_face_count
    uint64_t budgeted_floor_face_estimate = 0;  // the same where all boundaries but borders may move, as far as they like
};

// Finds all of it. mesh: as the input gives it (ids in range, no face with two equal corners, pools finite); what it lacks counts
// as equal everywhere: white, texture coordinate 0. Normals are brought to length 1; those of length 0, and those of corners
// without one, are made as crease_deg says. The same for any number of threads; renumbered with the faces. O(F + P), about 150
// bytes a face while it runs. Fails as pack_groups: an id has 16 bits.
Result<Groups> find_groups(const mesh::Mesh& mesh, const GroupOptions& options);

}  // namespace overlook::caveclod
