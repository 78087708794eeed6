#include "tools/measure/world.h"

#include <algorithm>

#include "formats/mapped_file.h"

namespace overlook::measure {
namespace {

// 4 bytes a sample and a texel, and a third more for the texture's coarser levels.
uint64_t bytes_on_card(const terrain::Terrain& terrain) {
    uint64_t texels = uint64_t(terrain.texture.width) * terrain.texture.height;
    return 4 * uint64_t(terrain.heights.size()) + 4 * texels * 4 / 3;
}

// A scene file, or the scene that a baked terrain makes by itself.
Result<scene::Scene> scene_of(const std::string& path) {
    if (!path.ends_with(".ovl")) return scene::read_scene(path);
    scene::Scene scene;
    scene.layers.push_back({path.substr(path.rfind('/') + 1), {}, "terrain", "", {}});
    return scene;
}

Result<void> check_layers(const std::string& path, const scene::Scene& scene) {
    constexpr const char* kOnly = "measure draws scenes of one terrain";
    if (scene.layers.size() != 1) return impossible("{}: has {} layers; {}", path, scene.layers.size(), kOnly);
    const std::string& method = scene.layers[0].method;
    if (method != "terrain") return impossible("{}: /layers/0/method: {} cannot be measured yet; {}", path, method, kOnly);
    return {};
}

// So near that nothing above the ground is cut off, whatever the size of the cells.
double near_m(const terrain::Terrain& terrain) {
    return std::min(0.5, 0.25 * std::min(terrain.frame.metres_per_column, terrain.frame.metres_per_row));
}

}  // namespace

Result<World> read_world(const std::string& path) {
    Result<scene::Scene> scene = scene_of(path);
    if (!scene) return tl::unexpected(scene.error());
    if (Result<void> checked = check_layers(path, *scene); !checked) return tl::unexpected(checked.error());
    std::string asset = scene::asset_path(path, scene->layers[0]);
    Result<MappedFile> scene_file = MappedFile::open(path), asset_file = MappedFile::open(asset);
    if (!scene_file) return tl::unexpected(scene_file.error());
    if (!asset_file) return tl::unexpected(asset_file.error());
    Result<terrain::Terrain> terrain = terrain::read(asset);
    if (!terrain) return tl::unexpected(terrain.error());

    World world;
    world.name = path.substr(path.rfind('/') + 1);
    std::string hashes = content_hash(scene_file->bytes()) + content_hash(asset_file->bytes());
    world.content_hash = content_hash(std::as_bytes(std::span(hashes)));
    world.terrain = std::make_unique<terrain::Terrain>(std::move(*terrain));
    world.refiner.emplace(*world.terrain);
    world.resident_bytes = bytes_on_card(*world.terrain);
    world.look.haze = scene->light.haze;
    // Mesa 22.3's llvmpipe loops for seconds, or for ever, on some triangles with anisotropic filtering.
    world.look.anisotropy = 1;
    world.transform = scene->layers[0].transform;
    world.base.fov_y_deg = scene->camera.fov_y_deg;
    world.base.near_m = scene->camera.near_m.value_or(near_m(*world.terrain) * world.transform.scale);
    return world;
}

Result<void> upload(World& world) {
    Result<terrain::Drawing> drawing = terrain::Drawing::make(*world.terrain);
    if (!drawing) return tl::unexpected(drawing.error());
    world.drawing.emplace(std::move(*drawing));
    return {};
}

}  // namespace overlook::measure
