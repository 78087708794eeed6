// The triangle mesh that the input gives and that every other part of the baker takes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace overlook::mesh {

constexpr uint32_t kNone = 0xffffffff;

struct Surface {
    std::string name;
    glm::vec4 base_colour{1, 1, 1, 1};
    std::string texture;                 // bare file name or ""
    std::vector<uint8_t> texture_bytes;  // embedded image, as stored
    bool is_alpha_masked = false;
    float alpha_cutoff = 0.5f;
    bool is_two_sided = false;
};

struct Mesh {
    glm::dvec3 origin_m{0};
    // [P] relative to origin_m, no two positions equal unless kept apart on purpose by repair (non-manifold pieces: `link`)
    std::vector<glm::vec3> positions_m;
    std::vector<std::array<uint32_t, 3>> faces;  // [F] position ids, counterclockwise seen from outside, none degenerate
    std::vector<uint32_t> face_surface;          // [F]
    std::vector<uint32_t> face_source;           // [F] index of the file's own triangle it comes from
    // Attributes by corner: index into the pool or kNone. [F] each, or empty when the file has none.
    std::vector<glm::vec3> normals;
    std::vector<std::array<uint32_t, 3>> face_normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::array<uint32_t, 3>> face_uvs;
    std::vector<glm::vec2> uvs2;
    std::vector<std::array<uint32_t, 3>> face_uvs2;
    std::vector<std::array<uint8_t, 4>> colours;
    std::vector<std::array<uint32_t, 3>> face_colours;
    std::vector<uint32_t>
        link;  // [P] or empty: positions cut apart by repair that are one point of the source carry the same number
    std::vector<Surface> surfaces;
};

}  // namespace overlook::mesh
