#include "runtime/player/scene.h"

#include <algorithm>

#include "formats/caveclod.h"
#include "formats/discrete.h"
#include "formats/terrain.h"
#include "runtime/player/record.h"
#include "runtime/view/flight.h"

namespace overlook::player {

namespace {

Result<scene::Scene> read_described(const std::string& path) {
    Result<scene::Scene> described = scene::read_scene(path);
    if (!described) return described;
    if (described->layers.size() > 1)
        return impossible("{}: /layers/1: the player draws one thing at a time; leave one layer", path);
    return described;
}

// What is drawn, by the kind of its file, if that is what the method draws.
Result<std::unique_ptr<Subject>> read_subject(const std::string& asset, const std::string& path, LayerMethod& layer,
                                              bool is_method_said, const std::optional<Streaming>& streaming) {
    Result<container::Reader> file = container::Reader::open(asset);
    if (!file) return tl::unexpected(file.error());
    Thing thing = file->kind() == caveclod::kKind ? Thing::mesh : file->kind() == discrete::kKind ? Thing::chain : Thing::terrain;
    if (thing == Thing::terrain && file->kind() != terrain::kKind) {
        return bad_input("{}: a file of kind {} cannot be drawn; a baked terrain, mesh or chain of levels is wanted", asset,
                         container::tag_text(file->kind()));
    }
    if (!is_method_said) layer.method = default_method(thing);
    if (!draws(layer.method, thing)) {
        return bad_input("{}: /layers/0/method: {} draws {}, and {} is a {}", path, name_of(layer.method),
                         things_of(layer.method), asset, name_of(thing));
    }
    if (thing != Thing::chain && !layer.instances.empty())
        return bad_input("{}: /layers/0/instances: {} is a {}; chains of levels have instances", path, asset, name_of(thing));
    if (thing != Thing::chain && layer.sets_chain)
        return bad_input("{}: /layers/0/settings: {} is a {}, of which discrete takes error_px alone", path, asset,
                         name_of(thing));
    if (thing == Thing::chain) {
        if (streaming) return impossible("{}: a chain of levels is read whole; --stream-memory is of terrains and meshes", asset);
        return read_chain(*file, layer);
    }
    if (streaming && thing == Thing::mesh) return read_streamed_mesh(std::move(*file), layer, *streaming);
    if (streaming) return read_streamed_terrain(std::move(*file), *streaming);
    return thing == Thing::mesh ? read_mesh(*file, layer) : read_terrain(*file, layer);
}

}  // namespace

Result<Scene> Scene::read(const std::string& path, const std::optional<Streaming>& streaming) {
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
    Result<std::unique_ptr<Subject>> subject = read_subject(asset, path, scene.layer_, path.ends_with(".json"), streaming);
    if (!subject) return tl::unexpected(subject.error());
    scene.subject_ = std::move(*subject);
    return scene;
}

Result<FrameRecord> Scene::draw(const gl::Target& target, const view::Camera& camera, const FrameStyle& style) {
    return subject_->draw(target, view::camera_into(transform(), camera), style);
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

view::ErrorBudget budget_of(const Options& options, Method method, double least_error_px) {
    if (options.triangles > 0 && (method == Method::caveclod || method == Method::caveclod_shared))
        return {0, least_error_px, false};
    if (options.triangles > 0) return {double(options.triangles), least_error_px, false};
    return {options.frame_ms, least_error_px, true};
}

double cost_of(const Options& options, const FrameRecord& frame) {
    return options.triangles > 0 ? double(frame.triangle_count) : frame.refine_ms + frame.draw_ms;
}

void settle(Plan& plan, const Scene& scene) {
    const scene::Scene& described = scene.described();
    plan.method = plan.method.value_or(scene.method());
    if (!plan.options.sets_error_px) plan.options.error_px = described.error_px;
    if (!plan.options.sets_haze) plan.draw.haze = described.light.haze;
    plan.base.fov_y_deg = described.camera.fov_y_deg;
    plan.base.near_m = described.camera.near_m.value_or(scene.subject().near_m() * scene.transform().scale);

    std::vector<scene::Key>& keys = plan.flight.keys;
    if (keys.empty()) {
        view::Camera local = scene.subject().overview(plan.width_px, plan.height_px);
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

}  // namespace overlook::player
