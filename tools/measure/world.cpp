#include "tools/measure/world.h"

#include <algorithm>
#include <limits>

#include "formats/container.h"
#include "formats/mapped_file.h"
#include "formats/wang_ground.h"
#include "runtime/terrain/near_plane.h"
#include "runtime/view/flight.h"

namespace overlook::measure {
namespace {

// 4 bytes a sample and a texel, and a third more for the texture's coarser levels.
uint64_t bytes_on_card(const terrain::Terrain& terrain) {
    uint64_t texels = uint64_t(terrain.texture.width) * terrain.texture.height;
    return 4 * uint64_t(terrain.heights.size()) + 4 * texels * 4 / 3;
}

// A scene file, or the scene that a baked file makes by itself.
Result<scene::Scene> scene_of(const std::string& path) {
    if (!path.ends_with(".ovl")) return scene::read_scene(path);
    scene::Scene scene;
    scene.layers.emplace_back().asset = path.substr(path.rfind('/') + 1);
    return scene;
}

constexpr const char* kOnly = "measure draws scenes of one terrain, one mesh or chains of levels";

// These say the near plane's distance, metres, so near that nothing is cut off that can be seen.
Result<double> read_terrain(const container::Reader& file, World& world) {
    if (file.kind() != terrain::kKind)
        return impossible("{}: a file of kind {} cannot be measured; {}", file.name(), container::tag_text(file.kind()), kOnly);
    Result<terrain::Terrain> terrain = terrain::read(file);
    if (!terrain) return tl::unexpected(terrain.error());
    world.terrain = std::make_unique<terrain::Terrain>(std::move(*terrain));
    world.refiner.emplace(*world.terrain);
    world.resident_bytes = bytes_on_card(*world.terrain);
    return std::min(0.5, 0.25 * std::min(world.terrain->frame.metres_per_column, world.terrain->frame.metres_per_row));
}

Result<double> read_mesh(const container::Reader& file, World& world) {
    constexpr double kNearShare = 1e-6;  // of its size; depths are reversed floats, so this costs no precision
    Result<caveclod::Hierarchy> hierarchy = caveclod::read(file);
    if (!hierarchy) return tl::unexpected(hierarchy.error());
    Result<caveclod::Mesh> mesh = caveclod::Mesh::make(*hierarchy);
    if (!mesh) return tl::unexpected(mesh.error());
    MeshWorld& made = world.mesh.emplace();
    made.hierarchy = std::make_unique<caveclod::Hierarchy>(std::move(*hierarchy));
    made.mesh = std::make_unique<caveclod::Mesh>(std::move(*mesh));
    world.resident_bytes = made.mesh->vertices().size_bytes() + made.mesh->colours().size_bytes();
    return std::min(0.5, kNearShare * glm::distance(made.mesh->lowest_m(), made.mesh->highest_m()) / 2);
}

Result<double> read_chain(const container::Reader& file, const scene::Layer& layer, World& world) {
    Result<discrete::Chain> chain = discrete::read(file);
    if (!chain) return tl::unexpected(chain.error());
    const ChainWorld& made = world.chains.emplace_back(chain_world(std::move(*chain), layer.instances, layer.transform));
    return discrete::near_plane_m(made.chain->radius_m, made.placements);
}

// By the kind of the file. hash grows by what it holds.
Result<double> read_layer(const scene::Scene& scene, const std::string& path, size_t place, World& world, std::string& hash) {
    const scene::Layer& layer = scene.layers[place];
    std::string asset = scene::asset_path(path, layer);
    Result<MappedFile> bytes = MappedFile::open(asset);
    if (!bytes) return tl::unexpected(bytes.error());
    hash += content_hash(bytes->bytes());
    Result<container::Reader> file = container::Reader::open(asset);
    if (!file) return tl::unexpected(file.error());
    if (file->kind() == discrete::kKind) return read_chain(*file, layer, world);
    if (scene.layers.size() > 1) {
        return impossible("{}: /layers/{}: {} is no chain of levels, and there are {} layers; {}", path, place, file->name(),
                          scene.layers.size(), kOnly);
    }
    if (!layer.instances.empty())
        return bad_input("{}: /layers/{}/instances: {} is no chain of levels", path, place, file->name());
    Result<double> near_m = file->kind() == caveclod::kKind ? read_mesh(*file, world) : read_terrain(*file, world);
    if (!near_m) return near_m;
    world.transform = layer.transform;
    return *near_m * layer.transform.scale;
}

bool is_planting(const scene::Layer& layer) {
    return layer.method == "wang-ldi";
}

// A file of the scene, which the hash grows by.
Result<container::Reader> open_hashed(const std::string& path, std::string& hash) {
    Result<MappedFile> bytes = MappedFile::open(path);
    if (!bytes) return tl::unexpected(bytes.error());
    hash += content_hash(bytes->bytes());
    return container::Reader::open(path);
}

// All layers of a scene that plants.
Result<double> read_planted(const scene::Scene& scene, const std::string& path, World& world, std::string& hash) {
    std::optional<container::Reader> planting;
    std::optional<terrain::Terrain> ground;
    scene::Planting described;
    for (size_t place = 0; place < scene.layers.size(); ++place) {
        const scene::Layer& layer = scene.layers[place];
        Result<container::Reader> file = open_hashed(scene::asset_path(path, layer), hash);
        if (!file) return tl::unexpected(file.error());
        if (is_planting(layer) ? planting || file->kind() != wang_ldi::kKind : ground || file->kind() != terrain::kKind)
            return impossible("{}: /layers/{}: {} is a second planting, or no terrain; measure draws one planting on one terrain",
                              path, place, file->name());
        if (is_planting(layer)) {
            described = layer.planting.value_or(described);
            planting = std::move(*file);
            continue;
        }
        Result<terrain::Terrain> terrain = terrain::read(*file);
        if (!terrain) return tl::unexpected(terrain.error());
        ground = std::move(*terrain), world.transform = layer.transform;
    }
    for (const std::string& model : described.models)
        if (auto file = open_hashed(scene::path_in_scene(path, model), hash); !file) return tl::unexpected(file.error());
    auto land = wang_ldi::PlantedLand::read(std::move(*planting), std::move(ground), described, path);
    if (!land) return tl::unexpected(land.error());
    if (Result<void> models = (*land)->read_models(); !models) return tl::unexpected(models.error());
    // A run is not to end in the middle for an image that nothing can be read from.
    const wang_ldi::ImageReader& images = (*land)->planted().images();
    for (uint64_t i = 0; i < images.set().ldi_count(); ++i)
        if (auto image = images.read(i); !image) return tl::unexpected(image.error());
    world.planted = std::move(*land);
    return wang_ldi::kPlantedNear_m * world.transform.scale;
}

}  // namespace

Result<World> read_world(const std::string& path) {
    Result<scene::Scene> scene = scene_of(path);
    if (!scene) return tl::unexpected(scene.error());
    Result<MappedFile> scene_file = MappedFile::open(path);
    if (!scene_file) return tl::unexpected(scene_file.error());

    World world;
    world.name = path.substr(path.rfind('/') + 1);
    world.asset_path = scene::asset_path(path, scene->layers.front());
    std::string hashes = content_hash(scene_file->bytes());
    double near_m = std::numeric_limits<double>::infinity();
    bool plants = std::any_of(scene->layers.begin(), scene->layers.end(), is_planting);
    if (plants) {
        Result<double> planted_m = read_planted(*scene, path, world, hashes);
        if (!planted_m) return tl::unexpected(planted_m.error());
        near_m = *planted_m;
    }
    for (size_t place = 0; place < (plants ? 0 : scene->layers.size()); ++place) {
        Result<double> least_m = read_layer(*scene, path, place, world, hashes);
        if (!least_m) return tl::unexpected(least_m.error());
        near_m = std::min(near_m, *least_m);
    }
    world.content_hash = content_hash(std::as_bytes(std::span(hashes)));
    world.look.haze = scene->light.haze;
    // Mesa 22.3's llvmpipe loops for seconds, or for ever, on some triangles with anisotropic filtering.
    world.look.anisotropy = 1;
    world.base.fov_y_deg = scene->camera.fov_y_deg;
    world.base.near_m = scene->camera.near_m.value_or(near_m);
    return world;
}

const MeshHonesty& MeshWorld::honesty() {
    if (!honesty_) honesty_ = std::make_unique<MeshHonesty>(*hierarchy);
    return *honesty_;
}

view::Camera World::local(const view::Camera& camera) const {
    view::Camera own = view::camera_into(transform, camera);
    if (is_planted()) return wang_ldi::with_clear_near_plane(planted->terrain(), planted->is_plain(), own);
    return is_mesh() || is_chain() ? own : terrain::with_clear_near_plane(*terrain, own);
}

bool ChainWorld::moves() const {
    return std::any_of(instances.begin(), instances.end(), [](const scene::Instance& one) { return one.moves(); });
}

void World::go_to(double time) {
    time_s = time;
    for (ChainWorld& one : chains)
        if (one.moves()) one.placements = discrete::placements_of(one.instances, one.whole, time);
}

ChainWorld chain_world(discrete::Chain chain, std::span<const scene::Instance> instances, const scene::Transform& whole) {
    ChainWorld made;
    made.chain = std::make_unique<discrete::Chain>(std::move(chain));
    made.facts = discrete::facts_of(*made.chain);
    made.instances.assign(instances.begin(), instances.end());
    made.whole = whole;
    made.placements = discrete::placements_of(instances, whole);
    return made;
}

Result<void> upload(World& world, uint32_t shading_rounds) {
    for (ChainWorld& one : world.chains) {
        Result<discrete::Drawing> drawing = discrete::Drawing::make(*one.chain, shading_rounds);
        if (!drawing) return tl::unexpected(drawing.error());
        world.resident_bytes += drawing->bytes();
        one.drawing.emplace(std::move(*drawing));
    }
    if (world.is_planted()) {
        Result<void> uploaded = world.planted->upload();
        if (!uploaded) return uploaded;
        world.resident_bytes = bytes_on_card(world.planted->terrain()) + world.planted->plants()->bytes();
        return {};
    }
    if (world.is_chain()) return {};
    if (world.is_mesh()) {
        Result<caveclod::Drawing> drawing = caveclod::Drawing::make(*world.mesh->mesh);
        if (!drawing) return tl::unexpected(drawing.error());
        world.mesh->drawing.emplace(std::move(*drawing));
        return {};
    }
    Result<terrain::Drawing> drawing = terrain::Drawing::make(*world.terrain);
    if (!drawing) return tl::unexpected(drawing.error());
    world.drawing.emplace(std::move(*drawing));
    return {};
}

}  // namespace overlook::measure
