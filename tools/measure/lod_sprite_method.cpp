#include "tools/measure/lod_sprite_method.h"

#include <algorithm>
#include <cassert>

#include "runtime/lod_sprite/director.h"
#include "runtime/lod_sprite/draw.h"
#include "tools/measure/capture.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kGridColumns = 64;  // of the depths that the director judges a key by

lod_sprite::Settings settings_of(const MethodSpec& spec) {
    lod_sprite::Settings settings;
    settings.error_px = setting(spec, "error-px");
    settings.low_error_px = setting(spec, "low-error-px");
    settings.key_error_px = setting(spec, "key-error-px");
    settings.scale = uint32_t(setting(spec, "key-scale"));
    settings.guard = setting(spec, "guard");
    settings.slots = uint32_t(setting(spec, "slots"));
    settings.fade_frames = uint32_t(setting(spec, "fade-frames"));
    settings.mode = setting(spec, "sliced") != 0 ? lod_sprite::KeyMode::sliced : lod_sprite::KeyMode::at_once;
    settings.morph = setting(spec, "morph");
    settings.draws_near = setting(spec, "near") != 0;
    return settings;
}

class LodSprite : public Method {
  public:
    LodSprite(World& world, const MethodSpec& spec)
        : world_(world),
          surface_(*world.drawing, world.look),
          near_surface_(*world.drawing, world.look),
          settings_(settings_of(spec)),
          director_(*world.refiner, settings_) {
        Result<lod_sprite::Painter> painter = lod_sprite::Painter::make(surface_, settings_.slots);
        assert(painter);
        painter_ = std::move(*painter);
        novel_.low_error_px = settings_.low_error_px;
        novel_.near_error_px = settings_.error_px;
        novel_.most_slack_m = world.refiner->highest_m() - world.refiner->lowest_m();
        novel_.tolerance_px = setting(spec, "tolerance-px");
        novel_.look_ups = uint32_t(setting(spec, "look-ups"));
        novel_.raises = setting(spec, "outlines") != 0;
        novel_.tests_slab = setting(spec, "slab-test") != 0;
        novel_.tests_places = setting(spec, "place-test") != 0;
        novel_.shows_sources = setting(spec, "sources") != 0;
    }

    void decide(const view::Camera& camera, uint32_t) override {
        if (camera.width_px != camera_.width_px || camera.height_px != camera_.height_px) director_.forget();
        camera_ = camera;
        work_ = director_.key_work(camera);
        is_drawn_ = false;
    }

    Counters draw(const gl::Target& target) override {
        if (!is_drawn_) draw_key();
        is_drawn_ = true;
        paint(target, novel_);
        Counters counters = counters_;
        counters.uploaded_bytes += surface_.uploaded_bytes();
        return counters;
    }

    std::optional<Sources> sources(const gl::Target& middle) override {
        if (novel_.keys.empty()) return std::nullopt;
        lod_sprite::NovelOptions mask = novel_;
        mask.is_mask = true;
        paint(middle, mask);
        Sources sources{mask_of(middle), {}};
        for (const lod_sprite::KeyUse& use : novel_.keys) sources.keys.push_back(painter_->texel_camera(use.slot));
        return sources;
    }

  private:
    void paint(const gl::Target& target, const lod_sprite::NovelOptions& options) {
        surface_.take(*plan_->cut);
        surface_.take_range({plan_->near_triangle_count});
        near_surface_.take_range({0, plan_->near_triangle_count});
        gl::Surface* near = plan_->near_triangle_count > 0 ? &near_surface_ : nullptr;
        [[maybe_unused]] Result<void> drawn = painter_->draw(target, near, surface_, camera_, options);
        assert(drawn);
    }
    uint32_t grid_step() const {
        return std::max(1u, lod_sprite::key_camera(camera_, settings_.guard).width_px * settings_.scale / kGridColumns);
    }

    // What of a key belongs to this frame, then the plan of the frame itself.
    void draw_key() {
        counters_ = {};
        if (work_) {
            if (work_->begin != nullptr) {
                [[maybe_unused]] Result<void> begun = painter_->begin_key(work_->slot, surface_, *work_->begin, settings_.scale);
                assert(begun);
                counters_.key_pixel_count =
                    uint64_t(work_->begin->width_px) * work_->begin->height_px * settings_.scale * settings_.scale;
            }
            surface_.take(*work_->slice);
            surface_.take_range({});
            painter_->draw_into_key(work_->slot, surface_);
            counters_.key_triangle_count = work_->slice->triangle_count();
            counters_.triangle_count += work_->slice->triangle_count();
            counters_.vertex_reference_count += work_->slice->indices.size();
            counters_.tested_count += work_->slice->tested_count;
            counters_.draw_call_count += 1;
            counters_.uploaded_bytes += surface_.uploaded_bytes();
            if (work_->is_last) director_.key_done(painter_->read_depth(work_->slot, grid_step()));
        }
        plan_ = &director_.novel();
        novel_.keys.clear();
        for (const lod_sprite::NovelUse& use : plan_->keys) novel_.keys.push_back({use.slot, use.weight});
        novel_.near_depth_m = plan_->near_depth_m;
        counters_.triangle_count += plan_->cut->triangle_count();
        counters_.vertex_reference_count += plan_->cut->indices.size();
        counters_.tested_count += plan_->cut->tested_count;
        counters_.draw_call_count += 2;
        counters_.predicted_error_px = plan_->error_p99_px;
        counters_.event_count = plan_->rekeyed != lod_sprite::Cause::none;
        counters_.resident_bytes = world_.resident_bytes + painter_->resident_bytes();
    }

    World& world_;
    terrain::CutSurface surface_, near_surface_;
    lod_sprite::Settings settings_;
    lod_sprite::Director director_;
    std::optional<lod_sprite::Painter> painter_;
    lod_sprite::NovelOptions novel_;
    std::optional<lod_sprite::KeyWork> work_;
    const lod_sprite::Novel* plan_ = nullptr;
    view::Camera camera_;
    Counters counters_;
    bool is_drawn_ = false;
};

}  // namespace

std::unique_ptr<Method> make_lod_sprite_method(World& world, const MethodSpec& spec) {
    return std::make_unique<LodSprite>(world, spec);
}

}  // namespace overlook::measure
