#include "tools/bake/wang_ldi/model_of_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/srgb.h"
#include "tools/bake/images.h"

namespace overlook::wang_ldi {
namespace {

class Maker {
  public:
    Maker(const mesh::Mesh& mesh, const ModelOptions& options) : mesh_(mesh), options_(options) {}
    Result<void> run(Models& models, TrimReport* trimmed);

  private:
    void add_triangles();
    Result<void> add_pictures();
    void add_looks();
    void add_masks();

    const mesh::Mesh& mesh_;
    const ModelOptions& options_;
    rays::Mesh shape_;
    Skin skin_;
    std::map<std::string, PictureRgba8> pictures_;  // by name
    std::map<std::string, uint32_t> textures_;      // of skin_.textures
};

void Maker::add_triangles() {
    for (const glm::vec3& position : mesh_.positions_m)
        shape_.positions_m.push_back(glm::vec3(glm::dvec3(position) + mesh_.origin_m));
    for (size_t f = 0; f < mesh_.faces.size(); ++f) {
        shape_.triangles.push_back(mesh_.faces[f]);
        glm::vec3 a = mesh::corner_m(mesh_, f, 0), b = mesh::corner_m(mesh_, f, 1), c = mesh::corner_m(mesh_, f, 2);
        glm::vec3 across = glm::cross(b - a, c - a);
        float length = glm::length(across);
        glm::vec3 flat = length > 0 ? across / length : glm::vec3(0, 0, 1);
        if (!mesh_.normals.empty()) {
            auto& normals = skin_.normals.emplace_back();
            for (size_t corner = 0; corner < 3; ++corner) {
                uint32_t at = mesh_.face_normals[f][corner];
                normals[corner] = at == mesh::kNone ? flat : mesh_.normals[at];
            }
        }
        if (!mesh_.uvs.empty()) {
            auto& uvs = shape_.uvs.emplace_back();
            for (size_t corner = 0; corner < 3; ++corner) {
                uint32_t at = mesh_.face_uvs[f][corner];
                uvs[corner] = at == mesh::kNone ? glm::vec2(0) : mesh_.uvs[at];
            }
        }
        if (!mesh_.colours.empty()) {
            auto& colours = skin_.colours.emplace_back();
            for (size_t corner = 0; corner < 3; ++corner) {
                uint32_t at = mesh_.face_colours[f][corner];
                for (size_t channel = 0; channel < 3; ++channel)
                    colours[corner][channel] = at == mesh::kNone ? uint8_t(255) : mesh_.colours[at][channel];
            }
        }
    }
}

Result<void> Maker::add_pictures() {
    for (const mesh::Surface& surface : mesh_.surfaces) {
        if (surface.texture_bytes.empty() || pictures_.count(surface.texture) > 0) continue;
        auto picture = picture_rgba8(surface.texture, std::as_bytes(std::span(surface.texture_bytes)));
        if (!picture) return tl::unexpected(picture.error());
        Texture texture{picture->width, picture->height, {}};
        for (size_t p = 0; p < picture->pixels.size(); ++p)
            if (p % 4 != 3) texture.pixels.push_back(picture->pixels[p]);
        textures_[surface.texture] = uint32_t(skin_.textures.size());
        skin_.textures.push_back(std::move(texture));
        pictures_[surface.texture] = std::move(*picture);
    }
    return {};
}

void Maker::add_looks() {
    skin_.looks.clear();
    for (const mesh::Surface& surface : mesh_.surfaces) {
        Look look;
        for (int c = 0; c < 3; ++c) look.albedo[c] = float(overlook::linear_from_srgb(double(surface.base_colour[c])));
        if (auto texture = textures_.find(surface.texture); texture != textures_.end() && !mesh_.uvs.empty())
            look.texture = texture->second;
        look.transmission = surface.is_two_sided ? options_.leaf_transmission : 0;
        look.roughness = options_.roughness.value_or(surface.roughness);
        look.metallic = options_.metallic.value_or(surface.metallic);
        skin_.looks.push_back(look);
    }
    skin_.looks_of = mesh_.face_surface;
}

// A mask for each masked surface whose opacity, its picture's (1 without one) times its own, is below the cutoff somewhere.
void Maker::add_masks() {
    std::vector<uint32_t> mask_of(mesh_.surfaces.size(), rays::kNone);
    for (size_t s = 0; s < mesh_.surfaces.size(); ++s) {
        const mesh::Surface& surface = mesh_.surfaces[s];
        if (!surface.is_alpha_masked) continue;
        float own = surface.base_colour.a, least = own > 0 ? surface.alpha_cutoff / own : surface.alpha_cutoff > 0 ? 2.0f : 0.0f;
        rays::Mask mask{1, 1, {255}, uint16_t(std::clamp(std::ceil(least * 255), 0.0f, 256.0f))};
        if (auto picture = pictures_.find(surface.texture); picture != pictures_.end() && !mesh_.uvs.empty()) {
            mask.width_px = picture->second.width, mask.height_px = picture->second.height, mask.opacity.clear();
            for (size_t p = 3; p < picture->second.pixels.size(); p += 4) mask.opacity.push_back(picture->second.pixels[p]);
        }
        if (std::all_of(mask.opacity.begin(), mask.opacity.end(), [&](uint8_t o) { return o >= mask.least; })) continue;
        mask_of[s] = uint32_t(shape_.masks.size());
        shape_.masks.push_back(std::move(mask));
    }
    if (shape_.masks.empty()) return;
    if (shape_.uvs.empty()) shape_.uvs.resize(shape_.triangles.size());
    for (uint32_t surface : mesh_.face_surface) shape_.masks_of.push_back(mask_of[surface]);
}

Result<void> Maker::run(Models& models, TrimReport* trimmed) {
    add_triangles();
    if (auto added = add_pictures(); !added) return added;
    add_looks();
    add_masks();
    if (options_.trims_leaves) {
        TrimReport report = trim_to_masks(shape_, skin_);
        if (trimmed) trimmed->add(report);
    }
    models.meshes.push_back(std::move(shape_));
    models.skins.push_back(std::move(skin_));
    return {};
}

}  // namespace

Result<void> add_model(const mesh::Mesh& mesh, const ModelOptions& options, Models& models, TrimReport* trimmed) {
    return Maker(mesh, options).run(models, trimmed);
}

}  // namespace overlook::wang_ldi
