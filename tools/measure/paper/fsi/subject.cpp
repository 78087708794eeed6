#include "tools/measure/paper/fsi/subject.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "runtime/view/flight.h"

namespace overlook::measure::paper::fsi {
namespace {

std::string folder_name(const std::string& folder) {
    std::filesystem::path path = std::filesystem::path(folder).lexically_normal();
    return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

bool has_things(const World& world) {
    return std::any_of(world.chains.begin(), world.chains.end(),
                       [](const ChainWorld& one) { return one.chain->levels.size() > 1; });
}

Result<World> world_of(const std::string& path) {
    Result<World> world = read_world(path);
    if (world && !has_things(*world))
        return impossible(
            "{}: holds no chain of several levels; reproduce fsi flies over what make-sample trees, windmills or simple made",
            path);
    return world;
}

Result<void> read_if_there(const std::string& path, std::optional<World>& into) {
    std::error_code problem;
    if (!std::filesystem::exists(path, problem)) return {};
    Result<World> read = world_of(path);
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

const ChainWorld& things_of(const World& world) {
    return *std::find_if(world.chains.begin(), world.chains.end(),
                         [](const ChainWorld& one) { return one.chain->levels.size() > 1; });
}

Result<Subject> read_subject(const std::string& folder) {
    Result<World> world = world_of(folder + "/scene.json");
    if (!world) return tl::unexpected(world.error());
    Result<scene::Flight> flight = scene::read_flight(folder + "/flight.json");
    if (!flight) return tl::unexpected(flight.error());
    Subject subject{folder_name(folder), std::move(*world), std::nullopt, std::nullopt, std::move(*flight)};
    for (auto [name, into] :
         {std::pair("scene-by-hand.json", &subject.by_hand), std::pair("scene-optimised.json", &subject.optimised)}) {
        if (Result<void> read = read_if_there(folder + "/" + name, *into); !read) return tl::unexpected(read.error());
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
