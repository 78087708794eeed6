#include "runtime/player/scene.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "runtime/gl/timer.h"
#include "runtime/player/flight.h"
#include "runtime/player/record.h"
#include "runtime/terrain/near_plane.h"
#include "runtime/view/flight.h"

namespace overlook::player {

namespace {

constexpr std::array<std::string_view, 1> kTerrainSettings = {"error_px"};

// The settings of a layer of terrain, put where they act.
Result<void> apply_settings(const std::string& path, scene::Scene& described) {
    for (const auto& [name, value] : described.layers.front().settings) {
        if (name != kTerrainSettings[0]) {
            return bad_input("{}: /layers/0/settings/{}: terrain has no such setting; did you mean {}?", path, name.substr(0, 64),
                             json::nearest(name.substr(0, 64), kTerrainSettings));
        }
        const double* error_px = std::get_if<double>(&value);
        if (error_px == nullptr || !(*error_px >= 0.001 && *error_px <= 10000))
            return bad_input("{}: /layers/0/settings/{}: a number from 0.001 to 10000 is wanted", path, name);
        described.error_px = *error_px;
    }
    return {};
}

Result<scene::Scene> read_described(const std::string& path) {
    Result<scene::Scene> described = scene::read_scene(path);
    if (!described) return described;
    const scene::Layer& layer = described->layers.front();
    if (described->layers.size() > 1)
        return impossible("{}: /layers/1: the player draws one terrain at a time; leave one layer", path);
    if (layer.method != "terrain")
        return impossible("{}: /layers/0/method: the player cannot draw {} yet; it draws terrain", path, layer.method);
    if (!layer.variant.empty()) return bad_input("{}: /layers/0/method: terrain has no variant {}", path, layer.variant);
    if (Result<void> applied = apply_settings(path, *described); !applied) return tl::unexpected(applied.error());
    return described;
}

}  // namespace

Result<Scene> Scene::read(const std::string& path) {
    Scene scene;
    std::string asset = path;
    if (path.ends_with(".json")) {
        Result<scene::Scene> described = read_described(path);
        if (!described) return tl::unexpected(described.error());
        scene.described_ = std::move(*described);
        asset = scene::asset_path(path, scene.described_.layers.front());
    } else {
        scene.described_.layers.emplace_back();
    }
    Result<terrain::Terrain> terrain = terrain::read(asset);
    if (!terrain) return tl::unexpected(terrain.error());
    scene.terrain_ = std::make_unique<terrain::Terrain>(std::move(*terrain));
    scene.refiner_.emplace(*scene.terrain_);
    return scene;
}

Result<void> Scene::upload() {
    Result<terrain::Drawing> drawing = terrain::Drawing::make(*terrain_);
    if (!drawing) return tl::unexpected(drawing.error());
    drawing_.emplace(std::move(*drawing));
    return {};
}

view::ErrorBudget budget_of(const Options& options, double least_error_px) {
    if (options.triangles > 0) return {double(options.triangles), least_error_px, false};
    return {options.frame_ms, least_error_px, true};
}

double cost_of(const Options& options, const FrameRecord& frame) {
    return options.triangles > 0 ? double(frame.triangle_count) : frame.refine_ms + frame.draw_ms;
}

FrameRecord Scene::draw(const gl::Target& target, const view::Camera& camera, double error_px, double morph,
                        const terrain::DrawOptions& options) {
    assert(drawing_.has_value());
    FrameRecord record;
    view::Camera local = terrain::with_clear_near_plane(*terrain_, view::camera_into(transform(), camera));
    gl::Timer refining;
    refiner_->cut_by_pixels(local, error_px, cut_, morph);
    record.refine_ms = refining.elapsed_ms();

    gl::Timer drawing;
    drawing_->draw(target, cut_, local, options);
    record.draw_ms = drawing.finished_ms();

    record.triangle_count = cut_.triangle_count();
    record.void_rim_triangle_count = cut_.void_rim_triangle_count;
    record.tested_count = cut_.tested_count;
    record.asked_error_px = error_px;
    record.predicted_error_px = cut_.predicted_error_px;
    record.uploaded_bytes = drawing_->uploaded_bytes();
    return record;
}

void settle(Plan& plan, const Scene& scene) {
    const scene::Scene& described = scene.described();
    if (!plan.options.sets_error_px) plan.options.error_px = described.error_px;
    if (!plan.options.sets_haze) plan.draw.haze = described.light.haze;
    plan.base.fov_y_deg = described.camera.fov_y_deg;
    plan.base.near_m = described.camera.near_m.value_or(near_m(scene.terrain()) * scene.transform().scale);

    std::vector<scene::Key>& keys = plan.flight.keys;
    if (keys.empty()) {
        view::Camera local =
            overview(scene.terrain(), scene.refiner().lowest_m(), scene.refiner().highest_m(), plan.width_px, plan.height_px);
        keys.push_back(key_of(view::camera_out_of(scene.transform(), local), 0));
    }
    uint32_t& frames = plan.options.frames;
    if (!plan.options.flight.empty()) {
        uint32_t whole = scene::frame_count(plan.flight);
        frames = frames == 0 ? whole : std::min(frames, whole);
    } else if (keys.size() > 1 && frames > 1) {
        plan.flight.step_s = keys.back().time_s / (frames - 1);
    }
}

double near_m(const terrain::Terrain& terrain) {
    double cell_m = std::min(terrain.frame.metres_per_column, terrain.frame.metres_per_row);
    return std::min(0.5, 0.25 * cell_m);
}

}  // namespace overlook::player
