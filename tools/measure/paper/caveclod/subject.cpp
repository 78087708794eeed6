#include "tools/measure/paper/caveclod/subject.h"

#include <filesystem>

#include "runtime/view/flight.h"

namespace overlook::measure::paper::cameras {
namespace {

Result<void> read_if_there(const std::string& path, std::optional<World>& world) {
    std::error_code problem;
    if (!std::filesystem::exists(path, problem)) return {};
    Result<World> read = read_world(path);
    if (!read) return tl::unexpected(read.error());
    if (!read->is_mesh()) return impossible("{}: holds a terrain; a mesh is wanted", path);
    world.emplace(std::move(*read));
    return {};
}

Result<void> read_flights(const std::string& folder, std::array<scene::Flight, kMostCameras>& flights) {
    for (uint32_t i = 0; i < kMostCameras; ++i) {
        std::string name = fmt::format("flight-{}.json", char('a' + i));
        Result<scene::Flight> flight = scene::read_flight(folder + "/" + name);
        if (!flight) return tl::unexpected(flight.error());
        if (i > 0 && flight->step_s != flights[0].step_s)
            return impossible("{}/{}: has steps of {} s, flight-a.json of {} s; all cameras fly at one step", folder, name,
                              flight->step_s, flights[0].step_s);
        flights[i] = std::move(*flight);
    }
    return {};
}

std::string folder_name(const std::string& folder) {
    std::filesystem::path path = std::filesystem::path(folder).lexically_normal();
    return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

}  // namespace

Result<Subject> read_subject(const std::string& folder) {
    Result<World> world = read_world(folder + "/scene.json");
    if (!world) return tl::unexpected(world.error());
    if (!world->is_mesh()) return impossible("{}/scene.json: holds a terrain; reproduce caveclod flies meshes", folder);
    Subject subject{folder_name(folder), std::move(*world), nullptr, {}, {}, {}, {}};
    subject.printed = std::make_unique<caveclod::paper::Mesh>(*subject.world.mesh->hierarchy);
    if (Result<void> read = read_flights(folder, subject.flights); !read) return tl::unexpected(read.error());
    for (auto [name, into] :
         {std::pair("groups", &subject.groups), std::pair("classes", &subject.classes), std::pair("ids", &subject.ids)}) {
        Result<void> read = read_if_there(fmt::format("{}/{}.ovl", folder, name), *into);
        if (!read) return tl::unexpected(read.error());
    }
    return subject;
}

Result<void> upload(Subject& subject) {
    for (World* world : {&subject.world, subject.groups ? &*subject.groups : nullptr,
                         subject.classes ? &*subject.classes : nullptr, subject.ids ? &*subject.ids : nullptr}) {
        if (world == nullptr) continue;
        if (Result<void> uploaded = measure::upload(*world); !uploaded) return uploaded;
    }
    return {};
}

view::Camera camera_at(const Subject& subject, uint32_t camera, double time_s, const view::Part& place) {
    view::Camera base = subject.world.base;
    base.width_px = place.width_px;
    base.height_px = place.height_px;
    return view::camera_into(subject.world.transform, view::camera_at(subject.flights[camera], time_s, base));
}

std::vector<view::Camera> cameras_at(const Subject& subject, uint32_t count, double time_s, uint32_t width_px,
                                     uint32_t height_px) {
    std::vector<view::Part> places = places_of(count, width_px, height_px);
    std::vector<view::Camera> cameras;
    for (uint32_t i = 0; i < count; ++i) cameras.push_back(camera_at(subject, i, time_s, places[i]));
    return cameras;
}

}  // namespace overlook::measure::paper::cameras
