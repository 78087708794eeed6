#include "tools/bake/wang_ldi/bake_key.h"

#include <span>
#include <type_traits>

#include "formats/container_rules.h"
#include "formats/wang_ldi_layout.h"
#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

// Raised whenever what a part holds, or how it is made, changes.
constexpr uint64_t kPartsVersion = 3;

// A hash of values and rows of them, as they lie in memory: for a key that never leaves this machine.
class Key {
  public:
    template <class T>
    void add(const T& value) {
        static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
        add_bytes(std::as_bytes(std::span(&value, 1)));
    }
    template <class T>
    void add_row(const std::vector<T>& row) {
        add(uint64_t(row.size()));
        add_bytes(std::as_bytes(std::span(row)));
    }
    uint64_t value() const { return value_; }

  private:
    void add_bytes(std::span<const std::byte> bytes) { value_ = mixed(value_ ^ container::checksum_of(bytes)); }
    uint64_t value_ = 1;
};

void add_models(const Models& models, Key& key) {
    for (size_t m = 0; m < models.meshes.size(); ++m) {
        const rays::Mesh& mesh = models.meshes[m];
        const Skin& skin = models.skins[m];
        key.add_row(mesh.positions_m), key.add_row(mesh.triangles), key.add_row(mesh.uvs), key.add_row(mesh.masks_of);
        key.add(uint64_t(mesh.masks.size())), key.add(uint64_t(skin.textures.size()));
        for (const rays::Mask& mask : mesh.masks) key.add(mask.width_px), key.add(mask.least), key.add_row(mask.opacity);
        key.add_row(skin.normals), key.add_row(skin.colours), key.add_row(skin.looks_of), key.add_row(skin.looks);
        for (const Texture& texture : skin.textures) key.add(texture.width_px), key.add_row(texture.pixels);
    }
}

void add_planting(const TileSet& tiles, const Planting& planting, Key& key) {
    key.add_row(tiles.tiles), key.add_row(tiles.horizontal), key.add_row(tiles.vertical), key.add_row(tiles.corner_density);
    key.add(planting.tile_size_m), key.add(uint64_t(planting.tiles.size()));
    for (const auto& objects : planting.tiles) {
        key.add(uint64_t(objects.size()));
        for (const Planted& object : objects) {
            key.add(object.model), key.add(object.x_m), key.add(object.y_m), key.add(object.turn_rad), key.add(object.scale);
            key.add(uint32_t(object.owner));
        }
    }
}

}  // namespace

uint64_t key_of(const TileSet& tiles, const Planting& planting, const Models& models, const ImageBake& bake,
                const ImageSet& set) {
    Key key;
    key.add(kPartsVersion);
    std::string_view instructions = rays::name_of(bake.instructions);
    for (std::string_view text : {std::string_view(bake.version), instructions})
        key.add_row(std::vector<char>(text.begin(), text.end()));
    add_models(models, key), add_planting(tiles, planting, key);
    key.add_row(bytes_of_head(set));
    const SampleOptions& sampling = bake.sampling;
    key.add(sampling.unseen_goal), key.add(sampling.fixed_rays), key.add(sampling.most_rays);
    key.add(uint64_t(sampling.least_eyes) << 32 | sampling.rays_per_eye);
    for (const glm::vec3& v : {bake.light.to_sun, bake.light.sun, bake.light.sky, bake.light.ground})
        key.add(v.x), key.add(v.y), key.add(v.z);
    key.add(bake.light.sun_radius_deg), key.add(uint64_t(bake.light.sun_rays) << 32 | bake.light.sky_rays);
    const TextureOptions& textures = bake.textures;
    key.add(uint64_t(textures.side_px) << 32 | textures.least_eyes), key.add(textures.unseen_goal), key.add(textures.error_goal);
    key.add(textures.most_rays), key.add(uint64_t(textures.rays_per_eye));
    key.add(uint64_t(bake.trial_tiles) << 32 | uint32_t(bake.has_gloss) << 1 | uint32_t(bake.is_covering));
    key.add(uint64_t(bake.neighbourhoods) << 32 | bake.judged_views), key.add(bake.memory_bytes), key.add(bake.seed);
    return key.value();
}

}  // namespace overlook::wang_ldi
