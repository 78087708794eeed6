// A triangle mesh as the bakers see it, whatever file it came from: positions shared by faces, everything else by corner.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace overlook::mesh {

// "This corner has no such attribute."
constexpr uint32_t kNone = 0xffffffff;

// What a face looks like: a material of the file. Its number is CAVECLOD's surface identifier.
struct Surface {
    std::string name;                    // the file's own, or ""
    glm::vec4 base_colour{1, 1, 1, 1};   // red, green, blue (sRGB-encoded), opacity, each 0..1
    std::string texture;                 // bare file name of the colour texture, or ""
    std::vector<uint8_t> texture_bytes;  // that picture's file (PNG, JPEG, ...), embedded or beside the mesh: with the first
                                         // surface of this texture name only; none if it is missing
    bool is_alpha_masked = false;        // texels of less opacity than alpha_cutoff are holes
    float alpha_cutoff = 0.5f;
    bool is_two_sided = false;          // drawn from behind too
    float roughness = 1, metallic = 0;  // as glTF has them, 0..1; these where a file does not say
};

// Indices of one face's three corners.
using Corners = std::array<uint32_t, 3>;

// What open_mesh gives keeps all of this:
// - every index is in range, every position, normal and texture coordinate finite;
// - no face has two equal positions, or three on one line (as exact arithmetic sees them);
// - no two faces have the same three positions, either way round;
// - every edge has one or two faces, two of them run along it in opposite directions, and the faces at a position form one fan
//   (open, or closed): so every library of halfedges takes every face;
// - every position is used by a face;
// - no value stands twice in a pool of attributes: corners have equal attributes exactly if they have equal indices.
struct Mesh {
    glm::dvec3 origin_m{0};              // of the positions, in the file's axes
    std::vector<glm::vec3> positions_m;  // [P], relative to origin_m. No two are equal but those that repair cut apart.
    std::vector<Corners> faces;          // [F] positions, counterclockwise seen from outside
    std::vector<uint32_t> face_surface;  // [F] index of surfaces
    std::vector<uint32_t> face_source;   // [F] number of the file's triangle (see MeshReport) that this one is; rises

    // Attributes by corner: [F] indices into the pool before them, or kNone; empty where the file has none.
    std::vector<glm::vec3> normals;  // of length 1
    std::vector<Corners> face_normals;
    std::vector<glm::vec2> uvs;  // first set; (0, 0) is the first texel of the texture's first row (glTF's sense)
    std::vector<Corners> face_uvs;
    std::vector<glm::vec2> uvs2;  // second set
    std::vector<Corners> face_uvs2;
    std::vector<std::array<uint8_t, 4>> colours;  // red, green, blue (sRGB-encoded), opacity
    std::vector<Corners> face_colours;

    // [P], or empty where nothing was cut. Positions that were one point of the source before repair cut sheets apart there carry
    // the same number, every other position its own: link[p] is the first position of p's class, so link[p] <= p. Where such a
    // position lies on a border a crack opens if it moves alone; where it lies on none (two cones that touch) only the touch is
    // lost. Back sides (a face that stands both ways round) are sheets of their own, not linked to their fronts: the two are
    // never seen from one place, so no crack can open between them.
    std::vector<uint32_t> link;

    std::vector<Surface> surfaces;  // at least one
};

// Where a face's corner lies, in metres from origin_m.
inline const glm::vec3& corner_m(const Mesh& mesh, size_t face, size_t corner) {
    return mesh.positions_m[mesh.faces[face][corner]];
}

}  // namespace overlook::mesh
