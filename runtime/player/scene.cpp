#include "runtime/player/scene.h"

#include <algorithm>

#include "formats/caveclod.h"
#include "formats/discrete.h"
#include "formats/terrain.h"
#include "formats/wang_ground.h"
#include "runtime/player/record.h"
#include "runtime/view/flight.h"

namespace overlook::player {

namespace {

Result<Thing> thing_in(const container::Reader& file) {
    if (file.kind() == discrete::kKind) return Thing::chain;
    if (file.kind() == caveclod::kKind) return Thing::mesh;
    if (file.kind() == terrain::kKind) return Thing::terrain;
    if (file.kind() == wang_ldi::kKind) return Thing::planting;
    return bad_input("{}: a file of kind {} cannot be drawn; a baked terrain, mesh, chain of levels or planting is wanted",
                     file.name(), container::tag_text(file.kind()));
}

Result<void> check_method(const std::string& path, const LayerMethod& layer, const std::string& asset, Thing thing,
                          size_t place = 0) {
    if (draws(layer.method, thing)) return {};
    return bad_input("{}: /layers/{}/method: {} draws {}, and {} is a {}", path, place, name_of(layer.method),
                     things_of(layer.method), asset, name_of(thing));
}

constexpr uint64_t kImages_bytes = uint64_t(1) << 30;  // of a planting in memory, where nobody says it

bool is_planting(const scene::Layer& layer) {
    return layer.method == "wang-ldi";
}

// What a scene plants, by the place of its layer, and the terrain that it stands on, if there is one.
Result<PlantingLayer> planting_of(const std::string& path, const scene::Scene& described, std::span<const std::string> assets,
                                  size_t place) {
    PlantingLayer read{{}, {}, described.layers[place].planting.value_or(scene::Planting()), path};
    for (size_t i = 0; i < assets.size(); ++i) {
        Result<container::Reader> file = container::Reader::open(assets[i]);
        if (!file) return tl::unexpected(file.error());
        Result<Thing> thing = thing_in(*file);
        if (!thing) return tl::unexpected(thing.error());
        const scene::Layer& layer = described.layers[i];
        if (i == place) {
            if (layer.transform != scene::Transform())
                return bad_input("{}: /layers/{}/transform: a planting stands where its ground is; move the terrain", path, i);
            read.file = std::move(*file);
            continue;
        }
        if (*thing != Thing::terrain || read.ground)
            return impossible("{}: /layers/{}: {} is a {}; the player draws one planting, on one terrain or a plain", path, i,
                              assets[i], name_of(*thing));
        if (layer.method != "terrain")
            return bad_input("{}: /layers/{}/method: {}; the ground of a planting is drawn by terrain", path, i, layer.method);
        read.ground = std::move(*file);
    }
    return read;
}

Streaming image_streaming(const std::optional<Streaming>& streaming, bool waits) {
    if (streaming) return *streaming;
    Streaming images;
    images.settings.residency_budget_bytes = kImages_bytes, images.settings.upload_budget_bytes = kImages_bytes;
    images.waits = waits;
    if (waits) images.settings.latency_frames = 1;
    return images;
}

// A scene's only layer, which holds no chain.
Result<std::unique_ptr<Subject>> read_subject(container::Reader file, Thing thing, const std::string& path,
                                              const scene::Layer& described, const LayerMethod& layer,
                                              const std::optional<Streaming>& streaming) {
    const std::string asset = file.name();
    if (!described.instances.empty())
        return bad_input("{}: /layers/0/instances: {} is a {}; chains of levels have instances", path, asset, name_of(thing));
    if (layer.sets_chain)
        return bad_input("{}: /layers/0/settings: {} is a {}, of which discrete takes error_px alone", path, asset,
                         name_of(thing));
    if (streaming && thing == Thing::mesh) return read_streamed_mesh(std::move(file), layer, *streaming);
    if (streaming) return read_streamed_terrain(std::move(file), *streaming);
    return thing == Thing::mesh ? read_mesh(file, layer) : read_terrain(file, layer);
}

// All layers of a scene, each a chain. assets: their files.
Result<std::unique_ptr<Subject>> read_chain_layers(const std::string& path, const scene::Scene& described,
                                                   std::span<const std::string> assets, const LayerMethod& layer) {
    std::vector<ChainLayer> chains;
    for (size_t i = 0; i < assets.size(); ++i) {
        const scene::Layer &first = described.layers.front(), &here = described.layers[i];
        Result<container::Reader> file = container::Reader::open(assets[i]);
        if (!file) return tl::unexpected(file.error());
        Result<Thing> thing = thing_in(*file);
        if (!thing) return tl::unexpected(thing.error());
        if (*thing != Thing::chain)
            return impossible("{}: /layers/{}: {} is a {}; of scenes of several layers the player draws chains of levels alone",
                              path, i, assets[i], name_of(*thing));
        if (here.method != first.method || here.variant != first.variant || here.settings != first.settings)
            return impossible(
                "{}: /layers/{}: asks for another method or settings than /layers/0; chains in one picture are drawn "
                "alike",
                path, i);
        chains.push_back({std::move(*file), here.instances, here.transform});
    }
    return read_chains(chains, layer.chain);
}

}  // namespace

Result<Scene> Scene::read(const std::string& path, const std::optional<Streaming>& streaming, bool waits) {
    Scene scene;
    std::vector<std::string> assets{path};
    bool is_described = path.ends_with(".json");
    size_t place = 0;  // of the layer that says how it is drawn
    if (is_described) {
        Result<scene::Scene> described = scene::read_scene(path);
        if (!described) return tl::unexpected(described.error());
        scene.described_ = std::move(*described);
        const std::vector<scene::Layer>& layers = scene.described_.layers;
        size_t planting = size_t(std::find_if(layers.begin(), layers.end(), is_planting) - layers.begin());
        if (planting < layers.size()) place = planting;
        Result<LayerMethod> layer = layer_method_of(path, scene.described_, place);
        if (!layer) return tl::unexpected(layer.error());
        scene.layer_ = *layer;
        assets.clear();
        for (const scene::Layer& each : scene.described_.layers) assets.push_back(scene::asset_path(path, each));
    } else {
        scene.described_.layers.emplace_back();
    }
    Result<container::Reader> file = container::Reader::open(assets[place]);
    if (!file) return tl::unexpected(file.error());
    Result<Thing> thing = thing_in(*file);
    if (!thing) return tl::unexpected(thing.error());
    if (!is_described) scene.layer_.method = default_method(*thing);
    if (Result<void> draws = check_method(path, scene.layer_, assets[place], *thing, place); !draws)
        return tl::unexpected(draws.error());
    if (*thing == Thing::planting) {
        Result<void> read = scene.read_planted(path, assets, place, image_streaming(streaming, waits));
        if (!read) return tl::unexpected(read.error());
        return scene;
    }
    bool is_of_chains = *thing == Thing::chain || assets.size() > 1;
    if (is_of_chains && streaming)
        return impossible("{}: a chain of levels is read whole; --stream-memory is of terrains, meshes and plantings",
                          assets.front());
    Result<std::unique_ptr<Subject>> subject =
        is_of_chains ? read_chain_layers(path, scene.described_, assets, scene.layer_)
                     : read_subject(std::move(*file), *thing, path, scene.described_.layers.front(), scene.layer_, streaming);
    if (!subject) return tl::unexpected(subject.error());
    scene.subject_ = std::move(*subject);
    // Where chains stand tells their placements.
    if (!is_of_chains) scene.transform_ = scene.described_.layers.front().transform;
    return scene;
}

Result<void> Scene::read_planted(const std::string& path, std::span<const std::string> assets, size_t place,
                                 const Streaming& streaming) {
    Result<PlantingLayer> planting = planting_of(path, described_, assets, place);
    if (!planting) return tl::unexpected(planting.error());
    Result<std::unique_ptr<Subject>> subject = read_planting(std::move(*planting), layer_, streaming);
    if (!subject) return tl::unexpected(subject.error());
    subject_ = std::move(*subject);
    for (size_t i = 0; i < described_.layers.size(); ++i)
        if (i != place) transform_ = described_.layers[i].transform;
    return {};
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

view::ErrorBudget budget_of(const Options& options, Method method, Thing thing, double least_error_px) {
    bool keeps_it = options.triangles > 0 ? keeps_triangles(method, thing) : keeps_ms(method, thing);
    if (keeps_it) return {0, least_error_px, false};
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
