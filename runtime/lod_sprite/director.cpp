#include "runtime/lod_sprite/director.h"

#include <cassert>
#include <cmath>

namespace overlook::lod_sprite {
namespace {

constexpr double kRoom = 1.5;  // a key promises so much better than frames from it, which come nearer than it

}  // namespace

Director::Director(Geometry& geometry, const Settings& settings)
    : geometry_(geometry), settings_(settings), spending_(settings.triangles), slots_(settings.slots) {
    assert(settings.slots >= 2);
}

void Director::forget() {
    for (Slot& slot : slots_) slot.is_whole = false;
    current_.reset(), before_.reset(), waiting_.reset(), making_.reset();
    fade_left_ = 0;
    has_drawn_ = false;
    track_.forget();
}

Reuse Director::reuse(uint32_t slot, const view::Camera& camera, const Shown* shown) const {
    double coarser = spending_.coarser(true);
    return reuse_of(slots_[slot].key, camera, settings_.low_error_px * coarser, fine_error_px() * coarser, shown);
}

void Director::use(uint32_t slot) {
    current_ = slot;
    current_shown_ = shown(slot);
    current_reuse_ = reuse(slot, camera_, &current_shown_);
}

// A key's own promise passes, whatever rounding made of it.
double Director::most_error_px() const {
    return settings_.key_error_px * spending_.keys_coarser() * (1 + 1e-6);
}

double Director::key_cut_px() const {
    double shown_px = std::max(settings_.error_px, settings_.texel_share / settings_.scale);
    return std::min(shown_px, settings_.key_error_px / kRoom) * spending_.keys_coarser();
}

bool Director::serves(const Reuse& reuse) const {
    return reuse.error_p99_px <= most_error_px() && reuse.magnification_p99 <= settings_.most_texel_px();
}

void Director::take_over(uint32_t slot) {
    if (slots_[slot].is_fresh) {
        if (has_taken_over_) life_frames_ = 0.5 * (life_frames_ + double(age_frames_));
        has_taken_over_ = true;
        age_frames_ = 0;
        took_over_ = slots_[slot].cause;
        slots_[slot].is_fresh = false;
    }
    // Back to the one that is being left: from where the fade has come to.
    bool turns_back = fade_left_ > 0 && has_before() && *before_ == slot;
    fade_left_ = turns_back ? settings_.fade_frames - fade_left_ : has_drawn_ ? settings_.fade_frames : 0;
    before_ = current_;
    if (waiting_ == slot) waiting_.reset();
    use(slot);
    is_cut_ = false;
}

// Another key would break the fade off: only if need be.
bool Director::is_fading() const {
    return fade_left_ > 0 && current_ && serves(current_reuse_);
}

// A key from the cache, where the one in use no longer serves and another does: going to and fro costs nothing.
void Director::judge_keys() {
    if (!current_) return;
    use(*current_);
    if (serves(current_reuse_)) return;
    for (uint32_t slot = 0; slot < slots_.size(); ++slot) {
        if (slot == *current_ || !slots_[slot].is_whole) continue;
        Shown other = shown(slot);
        if (serves(reuse(slot, camera_, &other))) return take_over(slot);
    }
}

// Does any key that is whole serve this camera? The one in use is asked first.
bool Director::is_served(const view::Camera& camera) const {
    if (current_ && serves(reuse(*current_, camera))) return true;
    for (uint32_t slot = 0; slot < slots_.size(); ++slot) {
        if (slots_[slot].is_whole && slot != current_ && serves(reuse(slot, camera))) return true;
    }
    return false;
}

// Whether the camera has jumped.
bool Director::begin_frame(const view::Camera& camera) {
    is_begun_ = true;
    camera_ = geometry_.with_near_plane(camera);
    bool has_jumped = track_.add(camera);
    slice_triangles_ = 0;
    took_over_ = Cause::none;
    judge_keys();
    if (waiting_ && !is_fading()) take_over(*waiting_);
    if (spending_.is_limited()) cut_coarse();
    is_cut_ = spending_.is_limited();
    return has_jumped;
}

std::optional<KeyWork> Director::key_work(const view::Camera& camera) {
    bool has_jumped = false;
    if (!is_begun_)
        has_jumped = begin_frame(camera);
    else if (!spends_all() || !spending_.is_much_left(slice_triangles_))
        return std::nullopt;
    if (making_ && !(current_ && serves(current_reuse_))) drop_wrong_key(has_jumped);
    if (!making_ && (!has_room() || !is_key_begun())) return std::nullopt;
    return settings_.mode == KeyMode::thread ? thread_work() : slice_work();
}

void Director::key_done(DepthGrid depths, uint64_t triangle_count) {
    assert(making_);
    if (settings_.mode == KeyMode::thread) making_->drawn_triangles = slice_triangles_ = triangle_count;
    Slot& slot = slots_[making_->slot];
    slot.key.depths = std::move(depths);
    slot.is_whole = slot.is_fresh = true;
    slot.triangle_count = expected_triangles_ = making_->drawn_triangles;
    ++keys_made_;
    Reuse made = reuse(making_->slot, camera_);
    // One that came out worse than what is at hand waits in the cache.
    bool is_better = !current_ || settings_.mode == KeyMode::at_once || made.error_p99_px <= current_reuse_.error_p99_px;
    if (is_better || serves(made)) {
        // Where every triangle is spent already, the cut that belongs to this key is the next frame's.
        if ((current_ && spends_all()) || is_fading())
            waiting_ = making_->slot;
        else
            take_over(making_->slot);
    }
    making_.reset();
}

}  // namespace overlook::lod_sprite
