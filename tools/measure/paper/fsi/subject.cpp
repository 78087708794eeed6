#include "tools/measure/paper/fsi/subject.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "formats/mapped_file.h"
#include "runtime/view/flight.h"

namespace overlook::measure::paper::fsi {
namespace {

std::string folder_name(const std::string& folder) {
    std::filesystem::path path = std::filesystem::path(folder).lexically_normal();
    return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

// What stands about, of another file than the scene names.
Result<World> world_of(const std::string& scene_path, const scene::Scene& scene, const scene::Layer& layer,
                       const std::string& asset) {
    constexpr double kNear_m = 0.5;
    Result<MappedFile> file = MappedFile::open(asset);
    if (!file) return tl::unexpected(file.error());
    Result<discrete::Chain> chain = discrete::read(asset);
    if (!chain) return tl::unexpected(chain.error());
    World world;
    world.name = scene_path.substr(scene_path.rfind('/') + 1);
    world.asset_path = asset;
    std::string hashes = content_hash(file->bytes()) + scene::json_from_scene(scene);
    world.content_hash = content_hash(std::as_bytes(std::span(hashes)));
    world.chain.emplace(chain_world(std::move(*chain), layer.instances));
    world.transform = layer.transform;
    world.base.fov_y_deg = scene.camera.fov_y_deg;
    world.base.near_m = scene.camera.near_m.value_or(kNear_m);
    return world;
}

Result<void> read_if_there(const std::string& scene_path, const scene::Scene& scene, const scene::Layer& layer,
                           const std::string& asset, std::optional<World>& into) {
    std::error_code problem;
    if (!std::filesystem::exists(asset, problem)) return {};
    Result<World> read = world_of(scene_path, scene, layer, asset);
    if (!read) return tl::unexpected(read.error());
    into.emplace(std::move(*read));
    return {};
}

}  // namespace

std::string title_of(const std::string& name) {
    std::string title = name;
    std::transform(title.begin(), title.end(), title.begin(), [](unsigned char c) { return char(std::toupper(c)); });
    return title;
}

Result<Subject> read_subject(const std::string& folder) {
    std::string path = folder + "/scene.json";
    Result<scene::Scene> scene = scene::read_scene(path);
    if (!scene) return tl::unexpected(scene.error());
    auto layer =
        std::find_if(scene->layers.begin(), scene->layers.end(), [](const scene::Layer& one) { return !one.instances.empty(); });
    if (layer == scene->layers.end())
        return impossible(
            "{}: nothing in it has instances; reproduce fsi flies over what make-sample trees, windmills or simple made", path);
    std::string asset = scene::asset_path(path, *layer);
    Result<World> world = world_of(path, *scene, *layer, asset);
    if (!world) return tl::unexpected(world.error());
    Result<scene::Flight> flight = scene::read_flight(folder + "/flight.json");
    if (!flight) return tl::unexpected(flight.error());
    Subject subject{folder_name(folder), std::move(*world), std::nullopt, std::nullopt, std::move(*flight)};
    std::string stem = asset.ends_with(".ovl") ? asset.substr(0, asset.size() - 4) : asset;
    for (auto [suffix, into] : {std::pair("-by-hand.ovl", &subject.by_hand), std::pair("-optimised.ovl", &subject.optimised)}) {
        if (Result<void> read = read_if_there(path, *scene, *layer, stem + suffix, *into); !read)
            return tl::unexpected(read.error());
    }
    return subject;
}

Result<void> upload(Subject& subject) {
    for (World* world :
         {&subject.world, subject.by_hand ? &*subject.by_hand : nullptr, subject.optimised ? &*subject.optimised : nullptr}) {
        if (world == nullptr) continue;
        if (Result<void> uploaded = measure::upload(*world); !uploaded) return uploaded;
    }
    return {};
}

std::vector<view::Camera> cameras_of(const Subject& subject, uint32_t count, uint32_t width_px, uint32_t height_px) {
    view::Camera base = subject.world.base;
    base.width_px = width_px, base.height_px = height_px;
    uint32_t all = scene::frame_count(subject.flight), first = std::min(all / 2, all - std::min(all, count));
    std::vector<view::Camera> cameras;
    for (uint32_t i = 0; i < std::min(all, count); ++i) {
        view::Camera camera = view::camera_at(subject.flight, scene::frame_time_s(subject.flight, first + i), base);
        cameras.push_back(subject.world.local(camera));
    }
    return cameras;
}

}  // namespace overlook::measure::paper::fsi
