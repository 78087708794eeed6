#include "runtime/lod_sprite/draw_paper_frames.h"

#include <algorithm>
#include <cassert>

namespace overlook::lod_sprite::paper {
namespace {

constexpr uint64_t kDrawCalls = 2;  // sky and ground

struct KnownSetting {
    SettingKind kind;
    void (*set)(FrameOptions&, double);
};

std::vector<KnownSetting> make_settings() {
    const FrameOptions is;
    using Options = FrameOptions;
    return {
        {{"error-px", 0.01, 1000, is.error_px}, [](Options& o, double v) { o.error_px = v; }},
        {{"low-error-px", 0.01, 1000, is.low_error_px}, [](Options& o, double v) { o.low_error_px = v; }},
        {{"key-error-px", 0.001, 1000, is.decide.key_error_px}, [](Options& o, double v) { o.decide.key_error_px = v; }},
        {{"drawn-plane", 0, 1, double(is.decide.error.plane == Plane::drawn), true, true, true},
         [](Options& o, double v) { o.decide.error.plane = v != 0 ? Plane::drawn : Plane::fan; }},
        {{"depth-thickness", 1e-9, 1e9, is.decide.depth.thickness, false, true},
         [](Options& o, double v) { o.decide.depth.thickness = v; }},
        {{"eye-depth", 0, 1, double(is.decide.depth.space == DepthSpace::eye), true, true, true},
         [](Options& o, double v) { o.decide.depth.space = v != 0 ? DepthSpace::eye : DepthSpace::window; }},
        {{"triangles", 0, 1e9, is.triangles, true, true}, [](Options& o, double v) { o.triangles = v; }},
        {{"strips", 0, 1, double(is.decide.strips.has_value()), true, true, true},
         [](Options& o, double v) { o.decide.strips = v != 0 ? std::optional(StripOptions{}) : std::nullopt; }},
    };
}

const std::vector<KnownSetting>& known_settings() {
    static const std::vector<KnownSetting> kKnown = make_settings();
    return kKnown;
}

Cause cause_of(KeyReason reason) {
    switch (reason) {
        case KeyReason::first:
            return Cause::first;
        case KeyReason::jump:
            return Cause::jump;
        case KeyReason::error:
            return Cause::error;
        default:
            return Cause::none;
    }
}

}  // namespace

std::span<const SettingKind> setting_kinds() {
    static const std::vector<SettingKind> kKinds = [] {
        std::vector<SettingKind> kinds;
        for (const KnownSetting& known : known_settings()) kinds.push_back(known.kind);
        return kinds;
    }();
    return kKinds;
}

void set(FrameOptions& options, std::string_view name, double value) {
    const std::vector<KnownSetting>& known = known_settings();
    auto found = std::find_if(known.begin(), known.end(), [&](const KnownSetting& one) { return one.kind.name == name; });
    assert(found != known.end() && value >= found->kind.least && value <= found->kind.most);
    found->set(options, value);
}

FrameDrawer::FrameDrawer(const terrain::Terrain& terrain, const terrain::Refiner& refiner, terrain::Drawing& ground,
                         const FrameOptions& options)
    : refiner_(refiner),
      ground_(ground),
      options_(options),
      controller_({options.triangles, 1, false}),
      sprite_(terrain, options.decide) {}

void FrameDrawer::decide(const view::Camera& camera) {
    camera_ = camera;
    is_kept_ = false;
    counts_ = {};
    refiner_.cut_by_pixels(camera, options_.low_error_px * controller_.error_px(), low_);
    controller_.frame_done(double(low_.triangle_count()));
    counts_.tested_count = low_.tested_count;
    decision_ = sprite_.decide(camera, low_);
    counts_.rekeyed = cause_of(decision_.reason);
    if (decision_.is_key())
        decide_key();
    else
        decide_novel();
}

void FrameDrawer::decide_key() {
    if (decision_.reason == KeyReason::first) drawing_.reset();  // none yet, or one of another size
    refiner_.cut_by_pixels(camera_, options_.error_px, high_);
    counts_.tested_count += high_.tested_count;
    counts_.error_p99_px = counts_.error_max_px = high_.predicted_error_px;
    counts_.key_triangle_count = high_.triangle_count();
    count(high_);
}

void FrameDrawer::decide_novel() {
    flags_ = sprite_.flags(low_);
    counts_.tested_count += decision_.error.quadrant_count;
    counts_.error_p99_px = counts_.error_max_px = decision_.error.rms_px;
    count(low_);
}

Result<FrameCounts> FrameDrawer::draw(const gl::Target& target) {
    if (!drawing_) {
        Result<Drawing> made = Drawing::make(ground_, camera_.width_px, camera_.height_px);
        if (!made) return tl::unexpected(made.error());
        drawing_ = std::move(*made);
    }
    uint64_t uploaded_bytes = 0;
    if (!decision_.is_key()) {
        drawing_->draw_novel(target, low_, flags_, sprite_.key_camera(), camera_, options_.look);
        uploaded_bytes = drawing_->uploaded_bytes();
    } else if (is_kept_) {
        ground_.draw(target, high_, camera_, options_.look);
        uploaded_bytes = ground_.uploaded_bytes();
    } else {
        if (Result<void> taken = take_key(target); !taken) return tl::unexpected(taken.error());
        uploaded_bytes = drawing_->uploaded_bytes();
    }
    FrameCounts counts = counts_;
    counts.live_key_count = counts.used_key_count = 1;
    counts.uploaded_bytes = uploaded_bytes;
    counts.resident_bytes = drawing_->resident_bytes();
    return counts;
}

std::optional<view::Camera> FrameDrawer::key_camera() const {
    if (decision_.is_key() || !drawing_) return std::nullopt;
    return sprite_.key_camera();
}

void FrameDrawer::draw_mask(const gl::Target& target) {
    drawing_->draw_mask(target, low_, flags_, sprite_.key_camera(), camera_, options_.look);
}

Result<void> FrameDrawer::take_key(const gl::Target& target) {
    Result<void> drawn = drawing_->draw_key(target, high_, camera_, options_.look, depth_);
    if (!drawn) return drawn;
    sprite_.keep(camera_, depth_, low_);
    is_kept_ = true;
    if (target.samples() > 1) {  // drawn a second time, for its depths
        counts_.key_triangle_count += high_.triangle_count();
        count(high_);
    }
    return {};
}

void FrameDrawer::count(const terrain::Cut& cut) {
    counts_.triangle_count += cut.triangle_count();
    counts_.vertex_reference_count += cut.indices.size();
    counts_.draw_call_count += kDrawCalls;
}

}  // namespace overlook::lod_sprite::paper
