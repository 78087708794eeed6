// Baked meshes that many cameras refine at once: a hierarchy of half-edge collapses of which every legal cut is made of triangles
// that the baker has seen.
//
// Collapsing u into t takes position u away: the faces round the edge go, the other faces of u's star turn their corner from u to
// t, and t stays where it is (no position ever moves: Hoppe 1998). Undone it is a *split*: of its owner t, creating position u.
// A split is legal when every face that it turns is there in exactly the version that the collapse left; as the versions of a
// face follow one another, that is a set of coarser splits which it *needs*, and a cut is any set of splits that holds, with
// each, what it needs. So one bit for each split and camera says all that is drawn.
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
#include <string_view>
#include <vector>

#include "formats/container.h"
#include "formats/result.h"

namespace overlook::caveclod {

constexpr container::Tag kKind = container::tag("CAVE");
constexpr uint32_t kCorners = 4;  // a corner of a face is written face * kCorners + 0, 1 or 2

// A set of directions: those within half_angle of an axis, in three bytes. Made by cone_of, so that rounding only ever widens it.
struct NormalCone {
    std::array<int8_t, 2> axis{0, 0};  // octahedral, -127..127
    uint8_t half_angle = 255;          // of 255 steps to half a turn; 255: every direction

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
    std::string name;                                   // UTF-8
    std::array<uint8_t, 4> colour{255, 255, 255, 255};  // sRGB-encoded, alpha linear
    std::string texture;                                // bare name, UTF-8; empty if there is none
    std::vector<std::byte> texture_bytes;               // the image as its file stores it (PNG, JPEG), or empty
    bool is_alpha_masked = false;                       // what is more transparent than alpha_cutoff is not drawn
    float alpha_cutoff = 0.5f;                          // 0..1
    bool is_two_sided = false;                          // seen from behind as well

    bool operator==(const Surface&) const = default;
};

// Where positions and attributes stand: those of a quantised hierarchy are whole steps from their lowest values.
struct Grid {
    double position_step_m = 0;  // 0: not quantised
    uint32_t position_bits = 0;
    glm::dvec2 uv_low{0};
    double uv_step = 0;
    uint32_t uv_bits = 0, normal_bits = 0;

    bool operator==(const Grid&) const = default;
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
    // applied. Finite, never above that of a split which i needs. That of a whole cut is the greatest over the splits that it
    // could apply next, and never below finest_error_m.
    std::vector<float> error_m;
    // [S] All versions of all faces that i and whatever needs it, directly or not, ever touch lie within radius_m of the owner's
    // position (the finest versions are the source). By complete().
    std::vector<float> radius_m;
    // [S] Holds the normals of all those versions. By complete().
    std::vector<NormalCone> cone;
    // Compressed rows: split i needs needs[need_begin[i] .. need_begin[i + 1]), ascending, each before i. By complete(), from
    // what the splits touch; a baker may give others before (rows as here, or both empty), which stay.
    std::vector<uint32_t> need_begin, needs;  // [S + 1], [..]
    std::vector<uint32_t> added_begin;        // [S + 1], from base_face_count; each split adds 0, 1 or 2
    // Compressed rows: corners (face * kCorners + corner) that go from owner[i] to the new position; ascending, no face twice,
    // none that i itself adds.
    std::vector<uint32_t> moved_begin, moved;  // [S + 1], [..]

    // Faces, counter-clockwise seen from outside, as they are when they come: in the coarsest cut, or right after their split. A
    // face that split i adds is (owner, older, new) or (owner, new, older), in this order where there are both (canonicalise()).
    std::vector<std::array<uint32_t, 3>> face_positions;  // [F]
    std::vector<uint32_t> face_group;                     // [F]
    std::vector<uint32_t> group_surface;                  // [G] index into surfaces
    // [G] the groups' identifiers by reuse: those that share a position differ (Kram and Shaw 2002, 3.3).
    std::vector<uint16_t> group_packed;

    // Render vertices, those of position p in [vertex_begin[p], vertex_begin[p + 1]): at least one, at most kMostWedges.
    std::vector<RenderVertex> vertices;      // [D]
    std::vector<uint32_t> vertex_begin;      // [P + 1]
    std::vector<uint16_t> birth_wedge;       // [3F] of each corner at its face's birth: offset in its position's row
    std::vector<uint16_t> moved_wedge;       // [as moved] after the split: offset in the new position's row
    std::vector<uint16_t> moved_back_wedge;  // [as moved] before it: offset in the owner's row
    Attributes attributes;

    std::vector<Surface> surfaces;
    Grid grid;                 // by quantise()
    float finest_error_m = 0;  // of the cut with every split applied: what quantising has moved

    uint32_t split_count() const { return uint32_t(owner.size()); }
    uint32_t new_position(uint32_t split) const { return base_position_count + split; }
};
constexpr uint32_t kMostWedges = 65535;
constexpr uint32_t kMostStar = 1024;  // faces at a split's owner before the split: what keeps reading linear

// Between a baker and write(): canonicalise, quantise, measure errors, complete.

// Turns and orders the faces that splits add, and orders moved rows, as Hierarchy asks; nothing that is drawn changes.
void canonicalise(Hierarchy& hierarchy);

// Fills needs, radius_m and cone from what the splits touch. Cost O(moved * valence). Fails with Exit::our_bug if the rows do not
// describe splits that can be applied one after the other: "split 17 moves a face that is not at its owner".
Result<void> complete(Hierarchy& hierarchy);

// How finely what is stored is stored.
struct Precision {
    uint32_t position_bits = 14;  // 8..20, of the longest side of the box round all positions
    uint32_t uv_bits = 14;        // 8..16, of the greater range
    uint32_t normal_bits = 10;    // 6..16, of each octahedral coordinate
};
// What quantising changed at most.
struct Quantised {
    double position_m = 0, normal_deg = 0, uv = 0;
};
// Moves positions and attributes to those that can be stored; origin_m goes to the lowest corner of the box round the positions,
// whose step has so few bits that every position is exact in a float. Positions may coincide afterwards; those that have a grid
// already (grid.position_step_m > 0) stay.
Quantised quantise(Hierarchy& hierarchy, const Precision& precision);
// Rounds errors up to those that can be stored (eighths of an octave: at most 9.1 % more) and, from fine to coarse, to what needs
// them. Needs must be complete.
void round_errors(Hierarchy& hierarchy);

// How the numbers in blocks are packed.
enum class Codec : uint32_t {
    meshopt = 0,  // meshoptimizer's vertex codec, then zstd
    draco = 1,    // Draco's symbol coding (rANS)
};
// The smaller one, by measurement: of 31,200 triangles of hills with normals and uv 34.4 bits a triangle, meshopt 37.2.
constexpr Codec kDefaultCodec = Codec::draco;

// Adds the hierarchy's sections to a baked file: MINF, MBLK, MDIR and MSUR. Errors are rounded up (round_errors). Same hierarchy,
// same bytes. Exit::our_bug if it is not quantised, complete and canonical: "a hierarchy to write has ...".
Result<void> write(container::Writer& writer, const Hierarchy& hierarchy, Codec codec = kDefaultCodec);

// Reads a hierarchy, whole or its first blocks: any number of them, 0 being the coarsest cut alone, is a hierarchy that can be
// drawn; its finest_error_m is then that of what is missing. The file may be hostile; every failure is Exit::bad_input and names
// file, rule and place: "head.ovl: M9: block 17: its bytes do not match their checksum; was the file damaged?".
// Exit::impossible if there is not so much memory.
Result<Hierarchy> read(const std::string& path);
Result<Hierarchy> read(const container::Reader& file, uint32_t most_blocks = ~0u);

// What each rule of these sections says, as container::rule_text.
std::string_view rule_text(int rule);
int rule_count();

}  // namespace overlook::caveclod
