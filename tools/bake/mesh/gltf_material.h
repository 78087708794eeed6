// Materials of a glTF file's JSON. A template, so that no header names the JSON library.
#pragma once

#include <algorithm>
#include <cmath>

#include "formats/srgb.h"
#include "formats/steady_math.h"
#include "tools/bake/mesh/gltf_document.h"
#include "tools/bake/mesh/gltf_json.h"

namespace overlook::mesh::gltf {

// The image of a texture; of those that an extension names (WebP, Basis) only where the texture has no other.
template <class Json>
uint32_t image_of_texture(const Json& root, uint64_t texture, size_t image_count, Values<Json>& values) {
    const Json& textures = values.array(root, "textures", "");
    if (texture >= textures.size()) return kNone;
    const Json& o = textures[texture];
    const std::string at = fmt::format("/textures/{}", texture);
    const uint32_t plain = values.reference(o, "source", image_count, at);
    if (plain != kNone) return plain;
    for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif"}) {
        const Json& extension = values.member(values.member(o, "extensions"), name);
        if (extension.is_object()) return values.reference(extension, "source", image_count, at);
    }
    return kNone;
}

// Khronos Group, "KHR_texture_transform", 2018: translation * rotation * scale, on columns (u, v, 1).
template <class Json>
void read_uv_transform(const Json& o, const std::string& at, Values<Json>& values, Material& material) {
    double offset[2] = {0, 0}, scale[2] = {1, 1};
    (void)values.numbers(o, "offset", offset, 2, at);
    (void)values.numbers(o, "scale", scale, 2, at);
    const double angle_rad = values.number(o, "rotation", 0, at), c = steady::cos(angle_rad), s = steady::sin(angle_rad);
    const glm::dmat3 translation(1, 0, 0, 0, 1, 0, offset[0], offset[1], 1), rotation(c, -s, 0, s, c, 0, 0, 0, 1);
    material.uv_transform = translation * rotation * glm::dmat3(scale[0], 0, 0, 0, scale[1], 0, 0, 0, 1);
    material.uv_set = uint32_t(std::min<uint64_t>(values.whole(o, "texCoord", material.uv_set, at), 99));
}

template <class Json>
void read_base_texture(const Json& root, const Json& o, size_t image_count, const std::string& at, Values<Json>& values,
                       Material& material) {
    if (!o.is_object()) return;
    const size_t texture_count = values.array(root, "textures", "").size();
    const uint32_t texture = values.needed_reference(o, "index", texture_count, at);
    if (texture != kNone) material.texture_image = image_of_texture(root, texture, image_count, values);
    material.uv_set = uint32_t(std::min<uint64_t>(values.whole(o, "texCoord", 0, at), 99));
    const Json& transform = values.member(values.member(o, "extensions"), "KHR_texture_transform");
    if (transform.is_object()) read_uv_transform(transform, at + "/extensions/KHR_texture_transform", values, material);
}

template <class Json>
std::vector<Material> read_materials(const Json& root, size_t image_count, Values<Json>& values) {
    std::vector<Material> materials;
    const Json& array = values.array(root, "materials", "");
    for (size_t i = 0; i < array.size(); ++i) {
        const std::string at = fmt::format("/materials/{}", i);
        const Json &o = array[i], &shading = values.member(o, "pbrMetallicRoughness");
        Material& material = materials.emplace_back();
        Surface& surface = material.surface;
        surface.name = values.text(o, "name");
        double colour[4] = {1, 1, 1, 1};
        (void)values.numbers(shading, "baseColorFactor", colour, 4, at + "/pbrMetallicRoughness");
        for (int k = 0; k < 4; ++k) {
            double linear = std::fmin(std::fmax(colour[k], 0.0), 1.0);
            surface.base_colour[k] = float(k < 3 ? srgb_from_linear(linear) : linear);
        }
        surface.is_alpha_masked = values.text(o, "alphaMode") == "MASK";
        surface.alpha_cutoff = float(values.number(o, "alphaCutoff", 0.5, at));
        surface.is_two_sided = values.boolean(o, "doubleSided");
        surface.roughness =
            std::clamp(float(values.number(shading, "roughnessFactor", 1, at + "/pbrMetallicRoughness")), 0.0f, 1.0f);
        surface.metallic =
            std::clamp(float(values.number(shading, "metallicFactor", 0, at + "/pbrMetallicRoughness")), 0.0f, 1.0f);
        read_base_texture(root, values.member(shading, "baseColorTexture"), image_count,
                          at + "/pbrMetallicRoughness/baseColorTexture", values, material);
    }
    return materials;
}

}  // namespace overlook::mesh::gltf
