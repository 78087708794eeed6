#include "tools/measure/lod_sprite_method.h"

#include <cassert>

#include "runtime/lod_sprite/draw_frames.h"
#include "runtime/lod_sprite/draw_on_mesh.h"
#include "runtime/lod_sprite/draw_on_terrain.h"
#include "tools/measure/capture.h"

namespace overlook::measure {
namespace {

lod_sprite::FrameOptions options_of(const MethodSpec& spec) {
    lod_sprite::FrameOptions options;
    for (const SettingKind& kind : lod_sprite::setting_kinds())
        lod_sprite::set(options, kind.name, setting(spec, std::string(kind.name)));
    return options;
}

std::unique_ptr<lod_sprite::DrawnGeometry> thing_of(World& world) {
    if (world.is_mesh())
        return std::make_unique<lod_sprite::DrawnMesh>(*world.mesh->mesh, *world.mesh->drawing, world.mesh->look);
    return std::make_unique<lod_sprite::DrawnTerrain>(*world.refiner, *world.drawing, world.look);
}

class LodSprite : public Method {
  public:
    LodSprite(World& world, const MethodSpec& spec) : world_(world) {
        auto frames = lod_sprite::FrameDrawer::make(thing_of(world), options_of(spec));
        assert(frames);
        frames_ = std::move(*frames);
    }

    void prepare(const view::Camera& camera, const gl::Target& target) override {
        [[maybe_unused]] Result<void> prepared = frames_->prepare(camera, target);
        assert(prepared);
    }
    void decide(const view::Camera& camera, uint32_t) override { frames_->decide(camera); }

    bool set_triangles(double triangles) override {
        frames_->set_triangles(triangles);
        return true;
    }

    Counters draw(const gl::Target& target) override {
        Result<lod_sprite::FrameCounts> drawn = frames_->draw(target);
        assert(drawn);
        Counters counters;
        counters.triangle_count = drawn->triangle_count;
        counters.vertex_reference_count = drawn->vertex_reference_count;
        counters.draw_call_count = drawn->draw_call_count;
        counters.uploaded_bytes = drawn->uploaded_bytes;
        counters.tested_count = drawn->tested_count;
        counters.resident_bytes = world_.resident_bytes + drawn->resident_bytes;
        counters.event_count = drawn->rekeyed != lod_sprite::Cause::none;
        counters.key_triangle_count = drawn->key_triangle_count;
        counters.key_pixel_count = drawn->key_pixel_count;
        counters.predicted_error_px = drawn->error_p99_px;
        return counters;
    }

    std::optional<Sources> sources(const gl::Target& middle) override {
        std::vector<view::Camera> keys = frames_->texel_cameras();
        if (keys.empty()) return std::nullopt;
        [[maybe_unused]] Result<void> drawn = frames_->draw_mask(middle);
        assert(drawn);
        return Sources{mask_of(middle), std::move(keys)};
    }

  private:
    World& world_;
    std::unique_ptr<lod_sprite::FrameDrawer> frames_;
};

}  // namespace

std::unique_ptr<Method> make_lod_sprite_method(World& world, const MethodSpec& spec) {
    return std::make_unique<LodSprite>(world, spec);
}

}  // namespace overlook::measure
