// Baked meshes that many cameras refine at once: a hierarchy of half-edge collapses of which every legal cut is made of triangles
// that the baker has seen.
//
// Collapsing u into t takes position u away: the faces round the edge go, the other faces of u's star turn their corner from u to
// t, and t stays where it is (no position ever moves: Hoppe 1998). Undone it is a *split*: of its owner t, creating position u.
// A split is legal when every face that it turns is there in exactly the version that the collapse left; as the versions of a face
// follow one another, that is a set of coarser splits which it *needs*, and a cut is any set of splits that holds, with each, what
// it needs. So one bit for each split and camera says all that is drawn.
//
// Based on: H. Hoppe, View-Dependent Refinement of Progressive Meshes, 1997; L. De Floriani, P. Magillo, E. Puppo, Building and
// Traversing a Surface at Variable Resolution, 1997 (any cut that is closed under needs); B. Kram, C. Shaw, Multiple Camera
// Considerations in a View-Dependent Continuous Level of Detail Algorithm, 2002 (surface groups, what cameras share). Different
// here: legality is that of all faces turned, not of Hoppe's four neighbours, so that no triangle is drawn that nobody measured.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "formats/container.h"
#include "formats/result.h"

namespace overlook::caveclod {

constexpr container::Tag kKind = container::tag("CAVE");
constexpr uint32_t kCorners = 4;  // a corner of a face is written face * kCorners + 0, 1 or 2

// A set of directions: those within half_angle of an axis, in four bytes. Made by cone_of, so that rounding only ever widens it.
struct NormalCone {
    std::array<int16_t, 2> axis{0, 0};  // octahedral, -1023..1023
    // Of 255 steps of half a turn; 255: every direction.
    uint8_t half_angle = 255;

    bool operator==(const NormalCone&) const = default;
};
// axis: any length but 0 (0 gives every direction); half_angle_rad: 0..pi. The cone holds all that the one given holds.
NormalCone cone_of(const glm::dvec3& axis, double half_angle_rad);
glm::dvec3 axis_of(const NormalCone& cone);  // of length 1
double half_angle_rad_of(const NormalCone& cone);

// One vertex of the vertex buffer: a position with the attributes of one fan of corners round it (a wedge: Hoppe 1996).
struct RenderVertex {
    uint32_t position = 0;
    glm::vec3 normal{0, 0, 1};  // of length 1
    glm::vec2 uv{0};
    std::array<uint8_t, 4> colour{255, 255, 255, 255};  // red, green, blue, alpha; sRGB-encoded, alpha linear

    bool operator==(const RenderVertex&) const = default;
};

// Which attributes the source has; those it has not stand at their defaults and are not stored.
struct Attributes {
    bool normals = false, uvs = false, colours = false;

    bool operator==(const Attributes&) const = default;
};

// What all faces of one surface identifier look like.
struct Surface {
    std::string name;                                // UTF-8
    std::array<uint8_t, 4> colour{255, 255, 255, 255};  // sRGB-encoded, alpha linear
    std::string texture;                             // bare name, UTF-8; empty if there is none
    std::vector<std::byte> texture_bytes;            // the image as its file stores it (PNG, JPEG), or empty
    bool is_alpha_masked = false;                    // what is more transparent than alpha_cutoff is not drawn
    float alpha_cutoff = 0.5f;                       // 0..1
    bool is_two_sided = false;                       // seen from behind as well

    bool operator==(const Surface&) const = default;
};

// Letters: P positions, S splits, F faces, D render vertices, G surface groups. P = base_position_count + S.
struct Hierarchy {
    glm::dvec3 origin_m{0};  // where the positions' origin lies in the world

    // Positions and faces below these exist in the coarsest cut; split i creates position base_position_count + i and faces
    // [added_begin[i], added_begin[i + 1]), numbered in the order of the splits.
    uint32_t base_position_count = 0, base_face_count = 0;
    std::vector<glm::vec3> positions_m;  // [P] relative to origin_m, finite

    // Splits, coarse to fine: what split i needs comes before it.
    std::vector<uint32_t> owner;  // [S] the position that is split; it is older than the new one
    // [S] Bounds the two-sided distance between the source and what is drawn, over all that split i touches, while i is not
    // applied. Finite, never above that of a split which i needs. That of a whole cut is the greatest over the splits that it could
    // apply next, and never below finest_error_m.
    std::vector<float> error_m;
    // [S] All that i and whatever needs it, directly or not, ever touch (drawn or source) lies within radius_m of the owner's
    // position. Finite. The sphere of a needed split holds that of i, up to kSphereSlack.
    std::vector<float> radius_m;
    // [S] Holds the normals of every face version, before and after, that i and whatever needs it touch, and of the source there.
    // A needed split's cone holds that of i.
    std::vector<NormalCone> cone;
    // Compressed rows: split i needs needs[need_begin[i] .. need_begin[i + 1]), ascending, each before i. Those that follow from
    // others may be left out.
    std::vector<uint32_t> need_begin, needs;  // [S + 1], [..]
    std::vector<uint32_t> added_begin;        // [S + 1], from base_face_count; each split adds 0, 1 or 2
    // Compressed rows: corners (face * kCorners + corner) that go from owner[i] to the new position; ascending, no face twice,
    // none that i itself adds.
    std::vector<uint32_t> moved_begin, moved;  // [S + 1], [..]

    // Faces, counter-clockwise seen from outside, as they are when they come: in the coarsest cut, or right after their split. A
    // face that split i adds has owner[i] at one corner, the new position at another, and an older position at the third.
    std::vector<std::array<uint32_t, 3>> face_positions;  // [F]
    std::vector<uint32_t> face_group;                     // [F]
    std::vector<uint32_t> group_surface;                  // [G] index into surfaces
    // [G] the groups' identifiers by reuse: those that share a position differ (Kram and Shaw 2002, 3.3).
    std::vector<uint16_t> group_packed;

    // Render vertices, those of position p in [vertex_begin[p], vertex_begin[p + 1]): at least one, at most kMostWedges.
    std::vector<RenderVertex> vertices;   // [D]
    std::vector<uint32_t> vertex_begin;   // [P + 1]
    std::vector<uint8_t> birth_wedge;     // [3F] of each corner at its face's birth: offset in its position's row
    std::vector<uint8_t> moved_wedge;     // [as moved] after the split: offset in the new position's row
    std::vector<uint8_t> moved_back_wedge;  // [as moved] before it: offset in the owner's row
    Attributes attributes;

    std::vector<Surface> surfaces;
    float finest_error_m = 0;  // of the cut with every split applied: what quantising has moved

    uint32_t split_count() const { return uint32_t(owner.size()); }
    uint32_t new_position(uint32_t split) const { return base_position_count + split; }
};
constexpr uint32_t kMostWedges = 255;
constexpr float kSphereSlack = 1e-4f;  // of the greater radius: what rounding may take from the nesting of spheres

}  // namespace overlook::caveclod
