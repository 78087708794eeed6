// Models as images of tiles are sampled from them: triangles for rays, and what each surface looks like.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "tools/bake/rays.h"

namespace overlook::wang_ldi {

// Reflected and let through, linear light.
struct Look {
    glm::vec3 albedo{1};
    uint32_t texture = rays::kNone;  // of Skin::textures, multiplies albedo
    float transmission = 0;          // of what falls on the back, how much is let through, beside albedo: 0..1
    float roughness = 1;             // 1: sends light back evenly, unless it is metal; 0..1, as glTF has it
    float metallic = 0;              // mirrors in its own colour and nothing else; 0..1
};

// 8-bit RGB, sRGB-encoded; repeats, (0, 0) the first texel of the first row.
struct Texture {
    uint32_t width_px = 0, height_px = 0;
    std::vector<uint8_t> pixels;  // [height, width, 3]
};

struct Skin {
    std::vector<std::array<glm::vec3, 3>> normals;               // [T] at corners, of length 1; empty: flat
    std::vector<std::array<std::array<uint8_t, 3>, 3>> colours;  // [T] at corners, sRGB-encoded, multiply; empty: white
    std::vector<uint32_t> looks_of;                              // [T] of looks; empty: all of the first
    std::vector<Look> looks = std::vector<Look>(1);
    std::vector<Texture> textures;
};

// Model m is meshes[m] with skins[m].
struct Models {
    std::vector<rays::Mesh> meshes;
    std::vector<Skin> skins;
};

// A place on a surface, as it is seen.
struct Point {
    glm::vec3 at_m{0};
    glm::vec3 face{0};    // the triangle's own normal, of length 1, towards the viewer
    glm::vec3 normal{0};  // the smooth one, on the same side
    glm::vec3 albedo{0};  // linear
    float transmission = 0, roughness = 1, metallic = 0;
    glm::vec3 to_eye{0};  // of length 1
};
// seen_along: from the viewer to the hit, any length. hit.copy is of copies.
Point point_of(const Models& models, std::span<const rays::Copy> copies, const rays::Hit& hit, const glm::vec3& seen_along);

// sRGB's curve (IEC 61966-2-1).
float linear_from_srgb(uint8_t code);
uint8_t srgb_from_linear(float value);  // clamped to 0..1

}  // namespace overlook::wang_ldi
