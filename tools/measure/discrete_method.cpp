#include "tools/measure/discrete_method.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "runtime/discrete/draw_frames.h"
#include "tools/measure/honesty/chain_honesty.h"

namespace overlook::measure {
namespace {

constexpr std::array<DiscreteVariant, 6> kVariants = {{{"fsi", discrete::Variant::fsi},
                                                       {"fsi-paper", discrete::Variant::fsi_paper},
                                                       {"switch", discrete::Variant::hard},
                                                       {"blend", discrete::Variant::blend},
                                                       {"dither", discrete::Variant::dither},
                                                       {"late", discrete::Variant::late}}};

discrete::FrameOptions options_of(const MethodSpec& spec) {
    auto found = std::find_if(kVariants.begin(), kVariants.end(), [&](const auto& one) { return one.name == spec.variant; });
    discrete::FrameOptions options = discrete::defaults_of(found == kVariants.end() ? kVariants.front().variant : found->variant);
    for (const auto& [name, value] : spec.settings) {
        if (name != "samples") discrete::set(options, name, value);
    }
    return options;
}

class Chain : public Method {
  public:
    Chain(World& world, const MethodSpec& spec) : world_(world) {
        std::vector<discrete::Stand> stands;
        for (const ChainWorld& one : world.chains) stands.push_back({&*one.drawing, one.placements});
        Result<std::unique_ptr<discrete::FrameDrawer>> frames = discrete::FrameDrawer::make(stands, options_of(spec));
        assert(frames);
        frames_ = std::move(*frames);
    }

    void prepare(const view::Camera& camera, const gl::Target& target) override {
        [[maybe_unused]] Result<void> prepared = frames_->prepare(camera, target);
        assert(prepared);
    }

    void decide(const view::Camera& camera, uint32_t frame) override {
        for (size_t i = 0; i < world_.chains.size(); ++i)
            if (world_.chains[i].moves()) frames_->place(world_.chains[i].placements, i);
        frames_->decide(camera, double(frame - last_frame_) * world_.step_s, double(frame) * world_.step_s);
        last_frame_ = frame;
        camera_ = camera;
    }

    bool set_triangles(double triangles) override {
        frames_->set_budget(triangles);
        return true;
    }

    Counters draw(const gl::Target& target) override {
        Result<discrete::FrameCounts> drawn = frames_->draw(target, {});
        assert(drawn);
        Counters counters;
        counters.triangle_count = drawn->triangle_count;
        counters.vertex_reference_count = 3 * counters.triangle_count;
        counters.draw_call_count = drawn->draw_call_count;
        counters.uploaded_bytes = drawn->uploaded_bytes;
        counters.tested_count = drawn->tested_count;
        counters.resident_bytes = world_.resident_bytes + drawn->resident_bytes;
        counters.event_count = drawn->begun_count;
        counters.transition_count = drawn->fading_count;
        counters.camera_bytes = drawn->state_bytes;
        counters.predicted_error_px = drawn->error_px;
        return counters;
    }

    std::optional<Promises> promises() override {
        while (honesties_.size() < world_.chains.size()) honesties_.emplace_back(*world_.chains[honesties_.size()].chain);
        Promises promises;
        for (size_t i = 0; i < honesties_.size(); ++i) honesties_[i].append_to(promises, frames_->director(i), camera_);
        return promises;
    }

  private:
    World& world_;
    std::unique_ptr<discrete::FrameDrawer> frames_;
    uint32_t last_frame_ = 0;
    view::Camera camera_;
    std::vector<ChainHonesty> honesties_;  // of each chain, when they were asked for
};

}  // namespace

std::span<const DiscreteVariant> discrete_variants() {
    return kVariants;
}

bool is_of_whole_meshes(std::string_view setting_name) {
    return setting_name == "error-px" || setting_name == "samples";
}

std::unique_ptr<Method> make_chain_method(World& world, const MethodSpec& spec) {
    return std::make_unique<Chain>(world, spec);
}

}  // namespace overlook::measure
