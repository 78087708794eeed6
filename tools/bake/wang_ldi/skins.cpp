#include "tools/bake/wang_ldi/skins.h"

#include <algorithm>
#include <cmath>

#include "formats/srgb.h"

namespace overlook::wang_ldi {
namespace {

// The texel of a place, not between texels: many rays average it.
glm::vec3 texel_at(const Texture& texture, const glm::vec2& uv) {
    auto place = [](float at, uint32_t count) {
        float whole = std::floor((at - std::floor(at)) * float(count));
        return whole >= 0 ? std::min(uint32_t(whole), count - 1) : 0u;
    };
    size_t texel = size_t(place(uv.y, texture.height_px)) * texture.width_px + place(uv.x, texture.width_px);
    const uint8_t* rgb = texture.pixels.data() + 3 * texel;
    return {linear_from_srgb(rgb[0]), linear_from_srgb(rgb[1]), linear_from_srgb(rgb[2])};
}

// Of the corners of a triangle, at a hit.
template <class Value>
Value between(const std::array<Value, 3>& corners, const rays::Hit& hit) {
    return corners[0] * (1 - hit.u - hit.v) + corners[1] * hit.u + corners[2] * hit.v;
}

glm::vec3 albedo_at(const rays::Mesh& mesh, const Skin& skin, const Look& look, const rays::Hit& hit) {
    glm::vec3 albedo = look.albedo;
    if (look.texture != rays::kNone && !mesh.uvs.empty())
        albedo *= texel_at(skin.textures[look.texture], between(mesh.uvs[hit.triangle], hit));
    if (skin.colours.empty()) return albedo;
    std::array<glm::vec3, 3> corners;
    for (size_t c = 0; c < 3; ++c)
        for (size_t channel = 0; channel < 3; ++channel)
            corners[c][int(channel)] = linear_from_srgb(skin.colours[hit.triangle][c][channel]);
    return albedo * between(corners, hit);
}

}  // namespace

float linear_from_srgb(uint8_t code) {
    return float(linear_from_srgb_code(code));
}

uint8_t srgb_from_linear(float value) {
    return uint8_t(overlook::srgb_from_linear(std::clamp(double(value), 0.0, 1.0)) * 255 + 0.5);
}

Point point_of(const Models& models, std::span<const rays::Copy> copies, const rays::Hit& hit, const glm::vec3& seen_along) {
    const rays::Copy& copy = copies[hit.copy];
    const rays::Mesh& mesh = models.meshes[copy.mesh];
    const Skin& skin = models.skins[copy.mesh];
    std::array<glm::vec3, 3> corners;
    for (size_t c = 0; c < 3; ++c) corners[c] = mesh.positions_m[mesh.triangles[hit.triangle][c]];

    Point point;
    point.at_m = copy.place * glm::vec4(between(corners, hit), 1);
    glm::mat3 turn(copy.place);  // a turn times a scale: normals need no inverse
    point.face = glm::normalize(turn * glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (glm::dot(point.face, seen_along) > 0) point.face = -point.face;
    point.normal = point.face;
    if (!skin.normals.empty()) {
        glm::vec3 smooth = turn * between(skin.normals[hit.triangle], hit);
        float length = glm::length(smooth);
        if (length > 1e-6f) point.normal = smooth * ((glm::dot(smooth, point.face) < 0 ? -1.0f : 1.0f) / length);
    }
    const Look& look = skin.looks[skin.looks_of.empty() ? 0 : skin.looks_of[hit.triangle]];
    point.albedo = albedo_at(mesh, skin, look, hit);
    point.transmission = look.transmission, point.roughness = look.roughness, point.metallic = look.metallic;
    point.to_eye = -glm::normalize(seen_along);
    return point;
}

}  // namespace overlook::wang_ldi
