#include "tools/measure/lod_sprite_paper_method.h"

#include <cassert>

#include "runtime/lod_sprite/draw_paper_frames.h"
#include "tools/measure/capture.h"

namespace overlook::measure {
namespace {

using namespace lod_sprite;

paper::FrameOptions options_of(const World& world, const MethodSpec& spec) {
    paper::FrameOptions options;
    for (const SettingKind& kind : paper::setting_kinds()) paper::set(options, kind.name, setting(spec, std::string(kind.name)));
    options.look = world.look;
    return options;
}

class LodSpritePaper : public Method {
  public:
    LodSpritePaper(World& world, const MethodSpec& spec)
        : world_(world), frames_(*world.terrain, *world.refiner, *world.drawing, options_of(world, spec)) {}

    void decide(const view::Camera& camera, uint32_t) override { frames_.decide(camera); }

    bool set_triangles(double triangles) override {
        frames_.set_triangles(triangles);
        return true;
    }

    // A keyframe is a frame of its own here: none of its triangles is drawn besides the picture's.
    Counters draw(const gl::Target& target) override {
        Result<FrameCounts> drawn = frames_.draw(target);
        assert(drawn);  // pictures of this size are drawn into already
        Counters counters;
        counters.triangle_count = drawn->triangle_count;
        counters.vertex_reference_count = drawn->vertex_reference_count;
        counters.draw_call_count = drawn->draw_call_count;
        counters.uploaded_bytes = drawn->uploaded_bytes;
        counters.tested_count = drawn->tested_count;
        counters.resident_bytes = world_.resident_bytes + drawn->resident_bytes + drawn->uploaded_bytes;
        counters.event_count = drawn->rekeyed != Cause::none;
        counters.predicted_error_px = drawn->error_p99_px;
        return counters;
    }

    // Of no keyframe, which is drawn in full.
    std::optional<Sources> sources(const gl::Target& middle) override {
        std::optional<view::Camera> key = frames_.key_camera();
        if (!key) return std::nullopt;
        frames_.draw_mask(middle);
        return Sources{mask_of(middle), {*key}};
    }

  private:
    World& world_;
    paper::FrameDrawer frames_;
};

}  // namespace

std::unique_ptr<Method> make_lod_sprite_paper_method(World& world, const MethodSpec& spec) {
    return std::make_unique<LodSpritePaper>(world, spec);
}

}  // namespace overlook::measure
