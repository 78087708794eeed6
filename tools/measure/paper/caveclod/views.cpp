#include "tools/measure/paper/caveclod/views.h"

#include <algorithm>

#include "tools/measure/paper/caveclod/table1.h"

namespace overlook::measure::paper::cameras {
namespace {

constexpr double kFlyoverShare = 0.4;  // of the flight's time

struct FlyoverFigure {
    int figure;
    uint32_t cameras;
};
FlyoverFigure flyover_of(const Subject& subject) {
    if (subject.name == kThreeLakes.name) return {7, 2};
    if (subject.name == kCanyon.name) return {9, 3};
    return {8, kMostCameras};
}

// From above the south, all of the mesh in sight.
view::Camera overview(const Subject& subject, const Flying& flying) {
    const caveclod::Mesh& mesh = subject.mesh();
    glm::dvec3 middle = 0.5 * (mesh.lowest_m() + mesh.highest_m()), size = mesh.highest_m() - mesh.lowest_m();
    view::Camera camera = subject.world.base;
    camera.width_px = flying.width_px;
    camera.height_px = flying.height_px;
    camera.heading_deg = 0;
    camera.pitch_deg = -58;
    double away_m = 0.85 * std::max(size.x, size.y);
    camera.position_m = middle + glm::dvec3(0, -0.55 * away_m, 0.85 * away_m);
    return camera;
}

struct Coloured {
    World* world;
    int figure;
    const char* caption;
};

}  // namespace

Result<std::vector<Picture>> pictures_of(Subject& subject, const Flying& flying) {
    std::vector<Picture> pictures;
    FlyoverFigure flyover = flyover_of(subject);
    double time_s = kFlyoverShare * subject.frame_count() * subject.step_s();
    Result<Picture> flown = flyover_picture(subject, flying, flyover.figure, flyover.cameras, time_s);
    if (!flown) return tl::unexpected(flown.error());
    pictures.push_back(std::move(*flown));

    auto of = [](std::optional<World>& world) { return world ? &*world : nullptr; };
    bool breaks_normals = subject.name == kCliff.name;
    const Coloured all[] = {
        {of(subject.groups), breaks_normals ? 1 : 2,
         breaks_normals ? "surface groups, a colour each, where normals and textures break."
                        : "surface groups, a colour each, where the surface identifier changes."},
        {of(subject.classes), 5, "FREE positions green, SHARP yellow, RIGID red."},
        {of(subject.ids), 6, "surface group identifiers, a colour each: groups that share no position have the same."}};
    for (const Coloured& one : all) {
        if (one.world == nullptr) continue;
        Result<Picture> picture = coloured_picture(*one.world, one.figure, overview(subject, flying), one.caption);
        if (!picture) return tl::unexpected(picture.error());
        pictures.push_back(std::move(*picture));
    }
    return pictures;
}

}  // namespace overlook::measure::paper::cameras
