#include "tools/measure/planting_method.h"

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

wang_ldi::FrameOptions options_of(const MethodSpec& spec) {
    wang_ldi::FrameOptions options = wang_ldi::defaults_of(variant_of(spec));
    for (const auto& [name, value] : spec.settings)
        if (name != kMemoryMib.name && name != kSamples.name) wang_ldi::set(options, name, value);
    return options;
}

wang_ldi::ImageStreaming streaming_of(const MethodSpec& spec) {
    wang_ldi::ImageStreaming streaming;
    streaming.settings.residency_budget_bytes = uint64_t(setting(spec, std::string(kMemoryMib.name)) * (1 << 20));
    streaming.settings.upload_budget_bytes = streaming.settings.residency_budget_bytes;
    streaming.settings.latency_frames = 1, streaming.waits = true;
    return streaming;
}

class Planting : public Method {
  public:
    Planting(World& world, const MethodSpec& spec) : world_(world) {
        frames_ = still(
            wang_ldi::FrameDrawer::make(world.planted->planted(), world.planted->land(), options_of(spec), streaming_of(spec)));
    }

    void decide(const view::Camera& camera, uint32_t frame) override {
        still(frames_->decide(camera, double(frame - last_frame_) * world_.step_s, terrain::kDefaultMorph));
        last_frame_ = frame;
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
        counters.outside_count = counts.field.outside_cell;
        counters.missing_count = counts.images.stand_ins + counts.images.missing;
        counters.predicted_error_px = counts.predicted_error_px;
        return counters;
    }

  private:
    World& world_;
    std::unique_ptr<wang_ldi::FrameDrawer> frames_;
    uint32_t last_frame_ = 0;
};

}  // namespace

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
