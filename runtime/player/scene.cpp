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

Result<scene::Scene> read_described(const std::string& path) {
    Result<scene::Scene> described = scene::read_scene(path);
    if (!described) return described;
    if (described->layers.size() > 1)
        return impossible("{}: /layers/1: the player draws one terrain at a time; leave one layer", path);
    return described;
}

// By either form of LOD-sprite.
template <class FrameDrawer>
Result<void> draw_sprite(FrameDrawer& frames, const gl::Target& target, const view::Camera& local, FrameRecord& record) {
    gl::Timer deciding;
    frames.decide(local);
    record.refine_ms = deciding.elapsed_ms();

    gl::Timer drawing;
    Result<lod_sprite::FrameCounts> drawn = frames.draw(target);
    if (!drawn) return tl::unexpected(drawn.error());
    record.draw_ms = drawing.finished_ms();

    record.triangle_count = drawn->triangle_count;
    record.tested_count = drawn->tested_count;
    record.predicted_error_px = drawn->error_p99_px;
    record.uploaded_bytes = drawn->uploaded_bytes;
    record.sprite = *drawn;
    return {};
}

}  // namespace

Result<Scene> Scene::read(const std::string& path) {
    Scene scene;
    std::string asset = path;
    if (path.ends_with(".json")) {
        Result<scene::Scene> described = read_described(path);
        if (!described) return tl::unexpected(described.error());
        scene.described_ = std::move(*described);
        Result<LayerMethod> layer = layer_method_of(path, scene.described_);
        if (!layer) return tl::unexpected(layer.error());
        scene.layer_ = *layer;
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

Result<void> Scene::upload(const gl::SecondContextMaker& second) {
    second_context_ = second;
    Result<terrain::Drawing> drawing = terrain::Drawing::make(*terrain_);
    if (!drawing) return tl::unexpected(drawing.error());
    drawing_.emplace(std::move(*drawing));
    return {};
}

void watch(KeyWatch& keys, const FrameRecord& frame) {
    if (!frame.sprite || frame.sprite->live_key_count == 0) {
        keys = {};
    } else if (frame.sprite->rekeyed != lod_sprite::Cause::none) {
        keys = {frame.sprite->rekeyed, 0};
    } else {
        ++keys.frames_ago;
    }
}

view::ErrorBudget budget_of(const Options& options, double least_error_px) {
    if (options.triangles > 0) return {double(options.triangles), least_error_px, false};
    return {options.frame_ms, least_error_px, true};
}

double cost_of(const Options& options, const FrameRecord& frame) {
    return options.triangles > 0 ? double(frame.triangle_count) : frame.refine_ms + frame.draw_ms;
}

Result<FrameRecord> Scene::draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) {
    assert(drawing_.has_value());
    view::Camera local = terrain::with_clear_near_plane(*terrain_, view::camera_into(transform(), camera));
    bool goes_on = style.method == last_method_ && style.error_px == last_error_px_;
    if (!goes_on) paper_.reset();
    if (!goes_on && style.method == Method::lod_sprite && sprite_) sprite_->change(with_error(layer_.sprite, style.error_px));
    last_method_ = style.method;
    last_error_px_ = style.error_px;

    FrameRecord record;
    record.asked_error_px = style.error_px;
    if (style.method == Method::terrain) {
        draw_terrain(target, local, style, record);
        return record;
    }
    Result<void> ready = ready_sprite(style);
    if (!ready) return tl::unexpected(ready.error());
    Result<void> drawn = style.method == Method::lod_sprite ? draw_sprite(*sprite_, target, local, record)
                                                            : draw_sprite(*paper_, target, local, record);
    if (!drawn) return tl::unexpected(drawn.error());
    return record;
}

// Whoever draws this method's sprites, with this error.
Result<void> Scene::ready_sprite(const FrameStyle& style) {
    terrain::DrawOptions look = style.look;
    look.look = terrain::Look::shaded;
    if (style.method == Method::lod_sprite_paper) {
        if (paper_) return {};
        lod_sprite::paper::FrameOptions options = with_error(layer_.paper, style.error_px);
        options.look = look;
        paper_ = std::make_unique<lod_sprite::paper::FrameDrawer>(*terrain_, *refiner_, *drawing_, options);
        return {};
    }
    if (!sprite_) {
        lod_sprite::FrameOptions options = with_error(layer_.sprite, style.error_px);
        options.look = look;
        auto made = lod_sprite::FrameDrawer::make(*refiner_, *drawing_, options, second_context_);
        if (!made) return tl::unexpected(made.error());
        sprite_ = std::move(*made);
    }
    sprite_->show_sources(style.shows_sources || layer_.sprite.draw.shows_sources);
    return {};
}

void Scene::draw_terrain(const gl::Target& target, const view::Camera& local, const FrameStyle& style, FrameRecord& record) {
    gl::Timer refining;
    refiner_->cut_by_pixels(local, style.error_px, cut_, style.morph);
    record.refine_ms = refining.elapsed_ms();

    gl::Timer drawing;
    drawing_->draw(target, cut_, local, style.look);
    record.draw_ms = drawing.finished_ms();

    record.triangle_count = cut_.triangle_count();
    record.void_rim_triangle_count = cut_.void_rim_triangle_count;
    record.tested_count = cut_.tested_count;
    record.predicted_error_px = cut_.predicted_error_px;
    record.uploaded_bytes = drawing_->uploaded_bytes();
}

void settle(Plan& plan, const Scene& scene) {
    const scene::Scene& described = scene.described();
    plan.method = plan.method.value_or(scene.method());
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
