#include "tools/measure/lod_sprite_paper_method.h"

#include <cassert>
#include <optional>
#include <span>
#include <vector>

#include "runtime/lod_sprite/draw_paper.h"
#include "runtime/lod_sprite/paper_sprite.h"
#include "tools/measure/capture.h"

namespace overlook::measure {
namespace {

using namespace lod_sprite;

constexpr uint64_t kDrawCalls = 2;  // sky and ground

paper::Options options_of(const MethodSpec& spec) {
    paper::Options options;
    options.key_error_px = setting(spec, "key-error-px");
    options.error.plane = setting(spec, "drawn-plane") != 0 ? paper::Plane::drawn : paper::Plane::fan;
    options.depth.thickness = setting(spec, "depth-thickness");
    options.depth.space = setting(spec, "eye-depth") != 0 ? paper::DepthSpace::eye : paper::DepthSpace::window;
    if (setting(spec, "strips") != 0) options.strips = paper::StripOptions{};
    return options;
}

class LodSpritePaper : public Method {
  public:
    LodSpritePaper(World& world, const MethodSpec& spec)
        : world_(world),
          high_error_px_(setting(spec, "error-px")),
          low_error_px_(setting(spec, "low-error-px")),
          sprite_(*world.terrain, options_of(spec)) {}

    void decide(const view::Camera& camera, uint32_t) override {
        camera_ = camera;
        is_kept_ = false;
        counters_ = {};
        world_.refiner->cut_by_pixels(camera, low_error_px_, low_);
        counters_.tested_count = low_.tested_count;
        decision_ = sprite_.decide(camera, low_);
        if (decision_.is_key())
            decide_key();
        else
            decide_novel();
    }

    Counters draw(const gl::Target& target) override {
        if (!decision_.is_key()) {
            drawing_->draw_novel(target, low_, flags_, sprite_.key_camera(), camera_, world_.look);
        } else if (is_kept_) {
            world_.drawing->draw(target, high_, camera_, world_.look);
        } else {
            take_key(target);
        }
        Counters counters = counters_;
        counters.uploaded_bytes = drawing_->uploaded_bytes();
        counters.resident_bytes = world_.resident_bytes + drawing_->resident_bytes() + counters.uploaded_bytes;
        return counters;
    }

    // Of no keyframe, which is drawn in full.
    std::optional<Sources> sources(const gl::Target& middle) override {
        if (decision_.is_key()) return std::nullopt;
        drawing_->draw_mask(middle, low_, flags_, sprite_.key_camera(), camera_, world_.look);
        return Sources{mask_of(middle), {sprite_.key_camera()}};
    }

  private:
    void decide_key() {
        if (decision_.reason == paper::KeyReason::first) {
            Result<paper::Drawing> made = paper::Drawing::make(*world_.drawing, camera_.width_px, camera_.height_px);
            assert(made);  // pictures of this size are drawn into already
            drawing_ = std::move(*made);
        }
        world_.refiner->cut_by_pixels(camera_, high_error_px_, high_);
        counters_.tested_count += high_.tested_count;
        counters_.event_count = 1;
        counters_.predicted_error_px = high_.predicted_error_px;
        count(high_.triangle_count(), high_.indices.size());
    }
    void decide_novel() {
        flags_ = sprite_.flags(low_);
        counters_.tested_count += decision_.error.quadrant_count;
        counters_.predicted_error_px = decision_.error.rms_px;
        count(low_.triangle_count(), low_.indices.size());
    }
    void take_key(const gl::Target& target) {
        [[maybe_unused]] Result<void> drawn = drawing_->draw_key(target, high_, camera_, world_.look, depth_);
        assert(drawn);
        sprite_.keep(camera_, depth_, low_);
        is_kept_ = true;
        if (target.samples() > 1) count(high_.triangle_count(), high_.indices.size());
    }
    void count(uint64_t triangles, uint64_t references) {
        counters_.triangle_count += triangles;
        counters_.vertex_reference_count += references;
        counters_.draw_call_count += kDrawCalls;
    }

    World& world_;
    double high_error_px_, low_error_px_;
    paper::Sprite sprite_;
    std::optional<paper::Drawing> drawing_;
    view::Camera camera_;
    terrain::Cut high_, low_;
    paper::Decision decision_;
    std::span<const uint8_t> flags_;
    std::vector<float> depth_;
    Counters counters_;
    bool is_kept_ = false;
};

}  // namespace

std::unique_ptr<Method> make_lod_sprite_paper_method(World& world, const MethodSpec& spec) {
    return std::make_unique<LodSpritePaper>(world, spec);
}

}  // namespace overlook::measure
