#include "runtime/lod_sprite/draw_frames.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace overlook::lod_sprite {
namespace {

constexpr uint32_t kGridColumns = 64;  // of the depths that the director judges a key by

constexpr std::array<std::string_view, 3> kKeyModes = {"at-once", "thread", "sliced"};
static_assert(size_t(KeyMode::sliced) + 1 == kKeyModes.size());

struct KnownSetting {
    SettingKind kind;
    void (*set)(FrameOptions&, double);
};

std::vector<KnownSetting> make_settings() {
    const FrameOptions is;
    auto number = [](std::string_view name, double least, double most, double otherwise, bool is_seldom) {
        return SettingKind{name, least, most, otherwise, false, is_seldom, false};
    };
    auto whole = [](std::string_view name, double least, double most, double otherwise) {
        return SettingKind{name, least, most, otherwise, true, true, false};
    };
    auto on_off = [](std::string_view name, bool otherwise) {
        return SettingKind{name, 0, 1, double(otherwise), true, true, true};
    };
    using Options = FrameOptions;
    return {
        {number("error-px", 0.01, 1000, is.decide.error_px, false), [](Options& o, double v) { o.decide.error_px = v; }},
        {number("low-error-px", 0.01, 1000, is.decide.low_error_px, false),
         [](Options& o, double v) { o.decide.low_error_px = v; }},
        {number("key-error-px", 0.01, 1000, is.decide.key_error_px, false),
         [](Options& o, double v) { o.decide.key_error_px = v; }},
        {whole("key-scale", 1, 4, is.decide.scale), [](Options& o, double v) { o.decide.scale = uint32_t(v); }},
        {number("texel-share", 0, 1, is.decide.texel_share, true), [](Options& o, double v) { o.decide.texel_share = v; }},
        {number("guard", 1, 3, is.decide.guard, true), [](Options& o, double v) { o.decide.guard = v; }},
        {number("most-grown", 1.1, 100, is.decide.most_grown, true), [](Options& o, double v) { o.decide.most_grown = v; }},
        {whole("slots", 2, 16, is.decide.slots), [](Options& o, double v) { o.decide.slots = uint32_t(v); }},
        {whole("fade-frames", 0, 60, is.decide.fade_frames), [](Options& o, double v) { o.decide.fade_frames = uint32_t(v); }},
        {{"keyframe", 0, kKeyModes.size() - 1.0, double(is.decide.mode), true, true, false, kKeyModes},
         [](Options& o, double v) { o.decide.mode = KeyMode(int(v)); }},
        {on_off("open-parts", is.decide.closes_open), [](Options& o, double v) { o.decide.closes_open = v != 0; }},
        {on_off("near", is.decide.draws_near), [](Options& o, double v) { o.decide.draws_near = v != 0; }},
        {number("morph", 0, 1, is.decide.morph, true), [](Options& o, double v) { o.decide.morph = v; }},
        {number("tolerance-px", 0.05, 10, is.draw.tolerance_px, true), [](Options& o, double v) { o.draw.tolerance_px = v; }},
        {whole("look-ups", 0, 16, is.draw.look_ups), [](Options& o, double v) { o.draw.look_ups = uint32_t(v); }},
        {on_off("outlines", is.draw.raises), [](Options& o, double v) { o.draw.raises = o.decide.keeps_outlines = v != 0; }},
        {on_off("slab-test", is.draw.tests_slab), [](Options& o, double v) { o.draw.tests_slab = v != 0; }},
        {on_off("place-test", is.draw.tests_places), [](Options& o, double v) { o.draw.tests_places = v != 0; }},
        {whole("triangles", 0, 1e9, is.decide.triangles), [](Options& o, double v) { o.decide.triangles = v; }},
        {on_off("sources", is.draw.shows_sources), [](Options& o, double v) { o.draw.shows_sources = v != 0; }},
    };
}

const std::vector<KnownSetting>& known_settings() {
    static const std::vector<KnownSetting> kKnown = make_settings();
    return kKnown;
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

std::string_view name_of(Cause cause) {
    constexpr std::array<std::string_view, 6> kNames = {"none", "first", "jump", "error", "magnified", "turned"};
    static_assert(size_t(Cause::turned) + 1 == kNames.size());
    return kNames[size_t(cause)];
}

Result<std::unique_ptr<FrameDrawer>> FrameDrawer::make(std::unique_ptr<DrawnGeometry> thing, const FrameOptions& options,
                                                       const gl::SecondContextMaker& second) {
    std::unique_ptr<FrameDrawer> made(new FrameDrawer(std::move(thing), options));
    const DrawnGeometry& drawn = *made->thing_;
    Result<Painter> painter =
        Painter::make(made->thing_->far(), options.decide.slots, made->thing_->geometry().is_error_vertical());
    if (!painter) return tl::unexpected(painter.error());
    made->painter_ = std::move(*painter);
    if (options.decide.mode == KeyMode::thread) {
        Result<std::unique_ptr<KeyThread>> thread = KeyThread::start(drawn, second);
        if (!thread) return tl::unexpected(thread.error());
        made->thread_ = std::move(*thread);
    }
    return made;
}

FrameDrawer::FrameDrawer(std::unique_ptr<DrawnGeometry> thing, const FrameOptions& options) : thing_(std::move(thing)) {
    settle(options);
}

void FrameDrawer::settle(const FrameOptions& options) {
    settings_ = options.decide;
    novel_ = options.draw;
    novel_.low_error_px = settings_.low_error_px;
    novel_.near_error_px = settings_.error_px;
    novel_.most_texel_px = settings_.most_texel_px();
    novel_.most_slack_m = thing_->geometry().most_slack_m();
    forget();
}

void FrameDrawer::change(const FrameOptions& options) {
    assert(options.decide.slots == settings_.slots);
    assert((options.decide.mode == KeyMode::thread) == (thread_ != nullptr));
    settle(options);
}

void FrameDrawer::set_triangles(double triangles) {
    settings_.triangles = triangles;
    director_->set_triangles(triangles);
}

// A director keeps what it learned of earlier keys, which a fresh one does not know.
void FrameDrawer::forget() {
    if (thread_) thread_->drop();
    director_.emplace(thing_->geometry(), settings_);
    is_whole_.assign(settings_.slots, false);
    work_.reset();
    plan_ = nullptr;
}

Result<void> FrameDrawer::prepare(const view::Camera& camera, const gl::Target& target) {
    Result<void> drawn = rehearse(thing_->geometry().with_near_plane(camera), target);
    forget();
    return drawn;
}

// With no key, one and two of them, each as it stands and as it fades.
Result<void> FrameDrawer::rehearse(const view::Camera& camera, const gl::Target& target) {
    Geometry& geometry = thing_->geometry();
    geometry.cut_coarse(camera, {settings_.low_error_px, settings_.morph, 0, settings_.error_px});
    thing_->take_coarse(geometry.put_near_first(camera, 0));
    for (uint32_t slot = 0; slot < 2; ++slot) {
        Result<void> begun = painter_->begin_key(slot, key_camera(camera, settings_.guard), settings_.scale);
        if (!begun) return begun;
        painter_->draw_into_key(slot, thing_->far());
        painter_->finish_key(slot, thing_->far());
    }
    for (uint32_t key_count = 0; key_count <= 2; ++key_count) {
        NovelOptions options = novel_;
        options.keys.clear();
        for (uint32_t slot = 0; slot < key_count; ++slot) options.keys.push_back({slot, 1});
        for (double own_weight : {0.0, 0.5}) {
            options.own_weight = own_weight;
            Result<void> drawn = painter_->draw(target, &thing_->far(), thing_->far(), camera, options);
            if (!drawn) return drawn;
        }
    }
    return {};
}

void FrameDrawer::decide(const view::Camera& camera) {
    bool is_resized = camera.width_px != camera_.width_px || camera.height_px != camera_.height_px;
    if (is_resized) forget();
    camera_ = camera;
    work_ = director_->key_work(camera);
    is_drawn_ = false;
}

Result<FrameCounts> FrameDrawer::draw(const gl::Target& target) {
    if (!is_drawn_) {
        counts_ = {};
        for (; work_; work_ = director_->key_work(camera_)) {
            if (Result<void> drawn = draw_key(); !drawn) return tl::unexpected(drawn.error());
        }
        plan();
        is_drawn_ = true;
    }
    if (Result<void> drawn = paint(target, novel_); !drawn) return tl::unexpected(drawn.error());
    FrameCounts counts = counts_;
    counts.uploaded_bytes += uploaded_bytes_;
    const Painter::Passes& passes = painter_->passes();
    uint64_t near = plan_->near_triangle_count, far = plan_->cut.triangle_count - near;
    counts.vertex_reference_count += 3 * (passes.near * near + passes.far * far);
    counts.draw_call_count +=
        passes.near * thing_->near().draw_call_count() + passes.far * thing_->far().draw_call_count() + passes.background;
    return counts;
}

Result<void> FrameDrawer::paint(const gl::Target& target, const NovelOptions& options) {
    uploaded_bytes_ = thing_->take_coarse(plan_->near_triangle_count);  // others may have drawn the thing meanwhile
    gl::Surface* near = plan_->near_triangle_count > 0 ? &thing_->near() : nullptr;
    return painter_->draw(target, near, thing_->far(), director_->camera(), options);
}

std::vector<view::Camera> FrameDrawer::texel_cameras() const {
    std::vector<view::Camera> cameras;
    for (const KeyUse& use : novel_.keys) cameras.push_back(painter_->texel_camera(use.slot));
    return cameras;
}

Result<void> FrameDrawer::draw_mask(const gl::Target& target) {
    NovelOptions mask = novel_;
    mask.is_mask = true;
    return paint(target, mask);
}

uint32_t FrameDrawer::grid_step() const {
    return std::max(1u, key_camera(camera_, settings_.guard).width_px * settings_.scale / kGridColumns);
}

// What of a key belongs to this frame.
Result<void> FrameDrawer::draw_key() {
    if (work_->begin != nullptr) {
        is_whole_[work_->slot] = false;
        counts_.key_pixel_count += uint64_t(work_->begin->width_px) * work_->begin->height_px * settings_.scale * settings_.scale;
    }
    return thread_ ? draw_beside() : draw_slice();
}

Result<void> FrameDrawer::draw_slice() {
    if (work_->begin != nullptr) {
        Result<void> begun = painter_->begin_key(work_->slot, *work_->begin, settings_.scale);
        if (!begun) return begun;
    }
    uint64_t uploaded_bytes = thing_->take_slice();
    painter_->draw_into_key(work_->slot, thing_->slice());
    count_key(*work_->slice, thing_->slice().draw_call_count(), uploaded_bytes);
    if (work_->is_last) {
        painter_->finish_key(work_->slot, thing_->slice());
        ++counts_.draw_call_count;
        director_->key_done(painter_->read_depth(work_->slot, grid_step()));
        is_whole_[work_->slot] = true;
    }
    return {};
}

// A key that the director gave up is let go when the next begins.
Result<void> FrameDrawer::draw_beside() {
    if (work_->begin != nullptr) {
        thread_->drop();
        Result<KeyPicture> picture = painter_->reserve_key(work_->slot, *work_->begin, settings_.scale);
        if (!picture) return tl::unexpected(picture.error());
        thread_->begin({*picture, work_->error_px, grid_step()});
        return {};
    }
    Result<KeyThread::Done> done = thread_->wait();
    if (!done) return tl::unexpected(done.error());
    count_key(done->count, done->draw_call_count, done->uploaded_bytes);
    ++counts_.draw_call_count;  // of its background
    director_->key_done(std::move(done->depths), done->count.triangle_count);
    is_whole_[work_->slot] = true;
    return {};
}

void FrameDrawer::count_key(const CutCount& count, uint64_t draw_call_count, uint64_t uploaded_bytes) {
    counts_.key_triangle_count += count.triangle_count;
    counts_.triangle_count += count.triangle_count;
    counts_.vertex_reference_count += 3 * count.triangle_count;
    counts_.tested_count += count.tested_count;
    counts_.draw_call_count += draw_call_count;
    counts_.uploaded_bytes += uploaded_bytes;
}

// The frame itself.
void FrameDrawer::plan() {
    plan_ = &director_->novel();
    novel_.keys.clear();
    for (const NovelUse& use : plan_->keys) novel_.keys.push_back({use.slot, use.weight});
    novel_.near_depth_m = plan_->near_depth_m;
    novel_.own_weight = plan_->own_weight;
    novel_.low_error_px = plan_->low_error_px;
    novel_.near_error_px = plan_->near_error_px;
    counts_.triangle_count += plan_->cut.triangle_count;
    counts_.near_triangle_count = plan_->near_triangle_count;
    counts_.tested_count += plan_->cut.tested_count;
    counts_.resident_bytes = painter_->resident_bytes();
    counts_.live_key_count = uint32_t(std::count(is_whole_.begin(), is_whole_.end(), true));
    counts_.used_key_count = uint32_t(plan_->keys.size());
    counts_.error_p99_px = plan_->error_p99_px;
    counts_.error_max_px = plan_->error_max_px;
    counts_.lost_share = plan_->lost_share;
    counts_.rekeyed = plan_->rekeyed;
}

}  // namespace overlook::lod_sprite
