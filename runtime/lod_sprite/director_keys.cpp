#include "runtime/lod_sprite/director.h"

#include <algorithm>
#include <limits>

namespace overlook::lod_sprite {
namespace {

constexpr uint32_t kHurriedSlices = 6;  // of a key that is missing
constexpr uint32_t kLeastSlices = 4;
constexpr uint32_t kSoon = 12;             // frames: while a key waits for its turn, another is begun only if both end sooner
constexpr double kRest = 0.7;              // a key whose error keeps under this share of the limit as far as one can see may rest
constexpr uint64_t kLeastSlice = 512;      // triangles
constexpr uint64_t kUnknownKey = 1 << 18;  // triangles, before there was one
constexpr double kAimAhead = 2.25;         // of the slices: a key ahead of the camera opens less than one behind it

}  // namespace

// How many frames the keys at hand will go on to serve if the camera goes on as it does; most_slices if for long.
uint32_t Director::frames_left() const {
    if (!current_ || !serves(current_reuse_)) return 0;
    uint32_t left = 0;
    for (uint32_t frames = 2; frames <= settings_.most_slices; frames = std::max(frames + 1, frames * 3 / 2)) {
        if (!is_served(track_.predicted(frames))) return std::max(left, kLeastSlices);
        left = frames;
    }
    return settings_.most_slices;
}

// Of a key that serves as far as one can see: is there nothing to be won by another, as its error is small or does not grow?
bool Director::may_rest() const {
    double now_px = current_reuse_.error_p99_px;
    return now_px <= kRest * most_error_px() ||
           reuse(*current_, track_.predicted(settings_.most_slices)).error_p99_px <= now_px * (1 + 1e-6);
}

Cause Director::cause_now() const {
    if (!current_) return Cause::first;
    if (current_reuse_.lost_share() > kMostLost) return Cause::jump;
    if (current_reuse_.magnification_p99 > settings_.most_texel_px()) return Cause::magnified;
    return current_reuse_.outside_share > current_reuse_.opened_share ? Cause::turned : Cause::error;
}

// The place of the key that would serve the camera least, none of those in use, and one that waits for its time last of all.
uint32_t Director::slot_to_empty() const {
    bool keeps_before = slots_.size() > 2;
    uint32_t worst = 0;
    double worst_error = -1;
    for (uint32_t slot = 0; slot < slots_.size(); ++slot) {
        if (!slots_[slot].is_whole) return slot;
        bool is_used = waiting_ == slot || current_ == slot || (before_ == slot && keeps_before);
        if (is_used) continue;
        Reuse found = reuse(slot, camera_);
        double error = slots_[slot].is_fresh ? 0 : found.error_p99_px + 1000 * found.lost_share();
        if (error > worst_error) {
            worst = slot;
            worst_error = error;
        }
    }
    return worst;
}

void Director::begin_key(const view::Camera& pose, Cause cause) {
    uint32_t slot = slot_to_empty();
    if (before_ && *before_ == slot) before_.reset();
    Slot& into = slots_[slot];
    into.is_whole = into.is_fresh = false;
    into.cause = cause;
    into.key.camera = geometry_.with_near_plane(key_camera(pose, settings_.guard));
    into.key.scale = settings_.scale;
    into.key.error_px = key_cut_px();
    making_.emplace();
    making_->slot = slot;
    making_->cause = cause;
    if (settings_.mode != KeyMode::thread) geometry_.begin_key(into.key.camera, into.key.error_px);
}

// Whether a budget is all used, for keys as fresh as there are triangles for. A camera that stands still needs no fresh ones.
bool Director::spends_all() const {
    bool moves = track_.speed_m() > 0 || track_.turning_deg() > 0;
    return settings_.mode == KeyMode::sliced && moves && spending_.binds(expected_triangles_, life_frames_);
}

// How many frames to make a key in, where the one in use goes on to serve for `left`.
uint32_t Director::frames_to_make(uint32_t left) {
    uint32_t frames = left == 0 ? kHurriedSlices : std::max(left, kHurriedSlices);
    if (!spends_all() || expected_triangles_ == 0) return frames;
    spending_.plan_key(expected_triangles_, settings_.most_slices);
    return std::max(spending_.frames_for(expected_triangles_), kHurriedSlices);
}

// What is left of the key over the frames left to make it in, which only get fewer: a key that is needed is hurried.
uint64_t Director::slice_triangles() {
    if (settings_.mode == KeyMode::at_once) return std::numeric_limits<uint64_t>::max();
    uint64_t most = std::max<uint64_t>(spending_.left(slice_triangles_), 1);
    if (spends_all()) return most;
    uint32_t left = making_->is_begun ? frames_left() : making_->frames_to_go;
    making_->frames_to_go = std::min(making_->frames_to_go, std::max(left, kHurriedSlices));
    uint64_t drawn = making_->drawn_triangles;
    uint64_t expected = expected_triangles_ > 0 ? expected_triangles_ : kUnknownKey;
    uint64_t rest = expected > drawn ? expected - drawn : expected / kHurriedSlices;
    uint64_t wanted = std::max(kLeastSlice, rest / making_->frames_to_go);
    making_->frames_to_go = std::max(1u, making_->frames_to_go - 1);
    return std::min(wanted, most);
}

// The paper's rule for a prediction that went wrong: use it where it is nearer than the old key, else begin anew.
void Director::drop_wrong_key(bool has_jumped) {
    const view::Camera& aim = slots_[making_->slot].key.camera;
    double aim_off_m = glm::length(aim.position_m - camera_.position_m);
    double old_off_m = current_ ? glm::length(slots_[*current_].key.camera.position_m - camera_.position_m) : aim_off_m;
    double speed_m = track_.speed_m() * settings_.most_slices;
    bool is_wrong = aim_off_m > old_off_m && aim_off_m > 2 * speed_m;
    if (is_wrong || has_jumped) making_.reset();
}

// Begins a key if one is due.
bool Director::is_key_begun() {
    bool is_served_now = current_ && serves(current_reuse_);
    if (settings_.mode == KeyMode::at_once) {
        if (is_served_now) return false;
        begin_key(track_.predicted(0), cause_now());
        return true;
    }
    uint32_t left = frames_left();
    if (left >= settings_.most_slices && may_rest() && !spends_all()) return false;
    bool has_next = std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.is_whole && slot.is_fresh; });
    if (has_next && left > kSoon && !spends_all()) return false;
    uint32_t frames = frames_to_make(left);
    if (settings_.mode == KeyMode::thread) {
        if (left > kThreadFrames) return false;
        frames = kThreadFrames;
    }
    begin_key(track_.predicted(kAimAhead * frames), is_served_now ? Cause::error : cause_now());
    making_->frames_to_go = frames;
    return true;
}

std::optional<KeyWork> Director::slice_work() {
    Geometry::Slice slice = geometry_.next_slice(slice_triangles());
    slice_triangles_ += slice.count.triangle_count;
    making_->drawn_triangles += slice.count.triangle_count;
    KeyWork work;
    work.slot = making_->slot;
    if (!making_->is_begun) work.begin = &slots_[making_->slot].key.camera;
    making_->is_begun = true;
    work.slice = slice.count;
    work.error_px = slots_[making_->slot].key.error_px;
    work.is_last = slice.is_last;
    return work;
}

// To the other thread in the frame it begins in, back from it kThreadFrames later.
std::optional<KeyWork> Director::thread_work() {
    KeyWork work;
    work.slot = making_->slot;
    work.error_px = slots_[making_->slot].key.error_px;
    if (!making_->is_begun) {
        making_->is_begun = true;
        work.begin = &slots_[making_->slot].key.camera;
        return work;
    }
    if (--making_->frames_to_go > 0) return std::nullopt;
    work.is_last = true;
    return work;
}

}  // namespace overlook::lod_sprite
