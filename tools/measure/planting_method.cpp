#include "tools/measure/planting_method.h"

#include <algorithm>
#include <map>

#include "runtime/terrain/refine.h"
#include "tools/measure/methods.h"
#include "tools/measure/still.h"

namespace overlook::measure {
namespace {

constexpr SettingKind kMemoryMib{"memory-mib", 1, 1 << 20, 1024, false, true};
constexpr SettingKind kSamples{"samples", 1, 8, 4, true};

wang_ldi::Variant variant_of(const MethodSpec& spec) {
    return spec.variant == "paper" ? wang_ldi::Variant::paper : wang_ldi::Variant::own;
}

// How much of a tile's places a means is shown at.
double share_of(const wang_ldi::Shown& shown) {
    return double(shown.by_rung.share()) * shown.by_direction.share() / (double(wang_ldi::kWhole) * wang_ldi::kWhole);
}

// Of the places of a tile, how many may be shown by the same means in both.
double same_share(std::span<const wang_ldi::Shown> a, std::span<const wang_ldi::Shown> b) {
    double same = 0;
    for (const wang_ldi::Shown& one : a)
        for (const wang_ldi::Shown& other : b)
            if (one.rung == other.rung && one.direction == other.direction) same += std::min(share_of(one), share_of(other));
    return same;
}

class Planting : public Method {
  public:
    Planting(World& world, const MethodSpec& spec) : world_(world) {
        frames_ = still(wang_ldi::FrameDrawer::make(world.planted->planted(), world.planted->land(), planting_options(spec),
                                                    streaming_of(spec)));
    }

    void decide(const view::Camera& camera, uint32_t frame) override {
        still(frames_->decide(camera, double(frame - last_frame_) * world_.step_s, terrain::kDefaultMorph));
        last_frame_ = frame;
        event_count_ = exchanged_tiles(before_, frames_->list());
        before_ = frames_->list();
    }

    Counters draw(const gl::Target& target) override {
        frames_->draw(target, world_.look);
        const wang_ldi::FrameCounts& counts = frames_->counts();
        Counters counters;
        counters.triangle_count = counts.triangle_count + counts.plants.triangle_count;
        counters.vertex_reference_count = 3 * counters.triangle_count;
        counters.draw_call_count = 3 + counts.plants.draw_call_count;  // sky, ground, what was warped
        counters.uploaded_bytes = counts.uploaded_bytes;
        counters.tested_count = counts.terrain_tested_count + counts.field.tiles_tested + counts.field.blocks_tested;
        counters.resident_bytes = world_.resident_bytes + counts.stream.resident_bytes;
        counters.streamed_bytes = counts.stream.resident_bytes;
        counters.sample_count = counts.warp.samples, counters.tile_count = counts.field.tiles_listed;
        counters.outside_count = counts.field.outside_cell, counters.is_eye_outside = counts.is_eye_outside;
        counters.event_count = event_count_;
        counters.missing_count = counts.images.stand_ins + counts.images.missing;
        counters.predicted_error_px = counts.predicted_error_px;
        return counters;
    }

    // By the error asked, which moves levels of plants and where images begin as well as the terrain.
    bool set_triangles(double triangles) override {
        frames_->set_budget(triangles);
        return true;
    }

  private:
    World& world_;
    std::unique_ptr<wang_ldi::FrameDrawer> frames_;
    wang_ldi::FieldList before_;
    uint64_t event_count_ = 0;
    uint32_t last_frame_ = 0;
};

}  // namespace

wang_ldi::FrameOptions planting_options(const MethodSpec& spec) {
    wang_ldi::FrameOptions options = wang_ldi::defaults_of(variant_of(spec));
    for (const auto& [name, value] : spec.settings)
        if (name != kMemoryMib.name && name != kSamples.name) wang_ldi::set(options, name, value);
    options.samples = uint32_t(setting(spec, std::string(kSamples.name)));
    return options;
}

wang_ldi::ImageStreaming streaming_of(const MethodSpec& spec) {
    wang_ldi::ImageStreaming streaming;
    streaming.settings.residency_budget_bytes = uint64_t(setting(spec, std::string(kMemoryMib.name)) * (1 << 20));
    streaming.settings.upload_budget_bytes = streaming.settings.residency_budget_bytes;
    streaming.settings.latency_frames = 1, streaming.waits = true;
    return streaming;
}

uint64_t exchanged_tiles(const wang_ldi::FieldList& before, const wang_ldi::FieldList& now) {
    std::map<std::pair<int64_t, int64_t>, const wang_ldi::Item*> known;
    for (const wang_ldi::Item& item : before.items)
        if (item.tiles_log2 == 0) known[{item.i, item.j}] = &item;
    uint64_t count = 0;
    for (const wang_ldi::Item& item : now.items) {
        auto found = item.tiles_log2 == 0 ? known.find({item.i, item.j}) : known.end();
        if (found != known.end()) count += same_share(before.shown_of(*found->second), now.shown_of(item)) <= 0.5;
    }
    return count;
}

std::vector<SettingKind> planting_settings(wang_ldi::Variant variant) {
    std::span<const SettingKind> own = wang_ldi::setting_kinds(variant);
    std::vector<SettingKind> all(own.begin(), own.end());
    all.push_back(kMemoryMib);
    all.push_back(kSamples);
    return all;
}

Result<void> check_planting(const MethodSpec& spec, const World& world) {
    const wang_ldi::PlantedField& planted = world.planted->planted();
    auto store = wang_ldi::ImageStore::open(planted.name(), planted.images(), streaming_of(spec).settings);
    if (!store) return tl::unexpected(Error{store.error().exit, "--method " + named(spec) + ": " + store.error().message});
    return {};
}

std::unique_ptr<Method> make_planting_method(World& world, const MethodSpec& spec) {
    return std::make_unique<Planting>(world, spec);
}

}  // namespace overlook::measure
