#include "tools/bake/wang_ldi/bake_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "formats/steady_math.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

Result<PerspectiveView> view_of(const SceneBake& bake, double side_m) {
    PerspectiveView view = bake.view;
    view.position_m += glm::dvec3(side_m / 2, side_m / 2, 0);
    bool is_inside =
        view.position_m.x >= 0 && view.position_m.y >= 0 && view.position_m.x <= side_m && view.position_m.y <= side_m;
    if (!is_inside) return bad_command("--scene-camera: the eye stands outside of the ground, which is {:g} m wide", side_m);
    glm::dvec2 across = glm::max(glm::dvec2(view.position_m), side_m - glm::dvec2(view.position_m));
    if (view.far_m == 0) view.far_m = std::max(glm::length(across) + std::abs(view.position_m.z), 2 * view.near_m);
    return view;
}

// The image's own view, then those away from it.
std::vector<PerspectiveView> views_of(const PerspectiveView& own, uint32_t directions) {
    std::vector<PerspectiveView> views{own};
    for (double distance_m : kPictureDistances_m)
        for (uint32_t d = 0; d < directions; ++d) {
            double heading = (own.heading_deg + 90 + 360.0 * d / directions) * M_PI / 180;
            PerspectiveView view = own;
            view.position_m += distance_m * glm::dvec3(steady::sin(heading), steady::cos(heading), 0);
            views.push_back(view);
        }
    return views;
}

}  // namespace

Result<SceneMade> bake_scene(const PlantedTiles& ground, const Models& models, const SceneBake& bake,
                             const std::function<void(double)>& progress) {
    SceneMade done;
    auto tiling = tile_square(ground.set, bake.side_tiles, bake.image.seed);
    if (!tiling) return tl::unexpected(tiling.error());
    auto view = view_of(bake, bake.side_tiles * ground.planting.tile_size_m);
    if (!view) return tl::unexpected(view.error());
    done.scene.columns = tiling->columns, done.scene.rows = tiling->rows, done.scene.tiles = tiling->tiles;
    auto begin = std::chrono::steady_clock::now();
    std::vector<rays::Copy> copies = copies_of_ground(ground.planting, tiling->tiles, tiling->columns);
    done.objects = copies.size();
    auto stage = stage_of(models, std::move(copies), bake.memory_bytes, bake.instructions);
    if (!stage) return tl::unexpected(stage.error());

    std::vector<PerspectiveView> views = views_of(*view, bake.directions);
    double share = 1.0 / double(1 + views.size() / 4);  // of the time, about
    Light light = bake.light;
    light.has_gloss = bake.has_gloss;
    auto image = perspective_of(models, *stage, *view, bake.image, light, [&](double of) { progress(share * of); });
    if (!image) return tl::unexpected(image.error());
    done.scene.image = std::move(image->image), done.image = std::move(*image), done.image.image = {};
    done.image_s = seconds_since(begin), begin = std::chrono::steady_clock::now();

    PerspectiveOptions one = bake.image;
    one.eyes = 1, one.layers = Layers::seen;
    for (size_t v = 0; v < views.size(); ++v) {
        auto at = [&](double of) { progress(share + (1 - share) * (double(v) + of) / double(views.size())); };
        auto picture = perspective_of(models, *stage, views[v], one, bake.light, at);
        if (!picture) return tl::unexpected(picture.error());
        done.scene.pictures.push_back(std::move(picture->image));
    }
    done.pictures_s = seconds_since(begin);
    return done;
}

}  // namespace overlook::wang_ldi
