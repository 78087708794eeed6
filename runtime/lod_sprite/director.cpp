#include "runtime/lod_sprite/director.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace overlook::lod_sprite {
namespace {

constexpr uint32_t kHurriedSlices = 6;  // of a key that is missing
constexpr uint32_t kLeastSlices = 4;
constexpr uint32_t kSoon = 12;        // frames: while a key waits for its turn, another is begun only if both end sooner
constexpr double kRest = 0.7;         // a key whose error keeps under this share of the limit as far as one can see may rest
constexpr double kMostLost = 0.3;     // of the frame: a key that has less to show is not looked into
constexpr double kFillWorth = 0.002;  // of the frame: so much must be lost for an older key to be looked into as well
constexpr double kFillWeight = 1.0 / 1024;
constexpr uint64_t kLeastSlice = 512;      // triangles
constexpr uint64_t kUnknownKey = 1 << 18;  // triangles, before there was one
constexpr double kAimAhead = 2.25;         // of the slices: a key ahead of the camera opens less than one behind it
constexpr double kRoom = 1.5;              // a key promises so much better than frames from it, which come nearer than it

}  // namespace

Director::Director(const terrain::Refiner& refiner, const Settings& settings)
    : refiner_(refiner), settings_(settings), spending_(settings.triangles), slots_(settings.slots) {
    assert(settings.slots >= 2);
}

void Director::forget() {
    for (Slot& slot : slots_) slot.is_whole = false;
    current_.reset(), before_.reset(), waiting_.reset(), making_.reset();
    fade_left_ = 0;
    track_.forget();
}

Reuse Director::reuse(uint32_t slot, const view::Camera& camera) const {
    double coarser = spending_.coarser(true);
    return reuse_of(slots_[slot].key, camera, settings_.low_error_px * coarser, settings_.error_px * coarser);
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
    return reuse.error_p99_px <= most_error_px() && reuse.magnification_p99 <= settings_.most_magnified;
}

void Director::take_over(uint32_t slot, const Reuse& reuse) {
    if (slots_[slot].is_fresh) {
        if (has_taken_over_) life_frames_ = 0.5 * (life_frames_ + double(age_frames_));
        has_taken_over_ = true;
        age_frames_ = 0;
        took_over_ = slots_[slot].cause;
        slots_[slot].is_fresh = false;
    }
    before_ = current_;
    current_ = slot;
    current_reuse_ = reuse;
    fade_left_ = before_ ? settings_.fade_frames : 0;
    is_cut_ = false;
}

// A key from the cache, where the one in use no longer serves and another does: going to and fro costs nothing.
void Director::judge_keys() {
    if (!current_) return;
    current_reuse_ = reuse(*current_, camera_);
    if (serves(current_reuse_)) return;
    for (uint32_t slot = 0; slot < slots_.size(); ++slot) {
        if (slot == *current_ || !slots_[slot].is_whole) continue;
        Reuse other = reuse(slot, camera_);
        if (serves(other)) return take_over(slot, other);
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
    if (current_reuse_.magnification_p99 > settings_.most_magnified) return Cause::magnified;
    return current_reuse_.outside_share > current_reuse_.opened_share ? Cause::turned : Cause::error;
}

// The place of the key that would serve the camera least, none of those in use, and one that waits for its time last of all.
uint32_t Director::slot_to_empty() const {
    uint32_t worst = 0;
    double worst_error = -1;
    for (uint32_t slot = 0; slot < slots_.size(); ++slot) {
        if (!slots_[slot].is_whole) return slot;
        bool is_used = waiting_ == slot || (current_ && *current_ == slot) || (before_ && *before_ == slot && slots_.size() > 2);
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
    into.key.camera = key_camera(pose, settings_.guard);
    into.key.scale = settings_.scale;
    into.key.error_px = key_cut_px();
    making_.emplace();
    making_->slot = slot;
    making_->cause = cause;
    if (settings_.mode != KeyMode::thread) making_->cut.emplace(refiner_, into.key.camera, into.key.error_px);
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
        begin_key(camera_, cause_now());
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
    uint64_t wanted = slice_triangles();
    making_->cut->next(wanted, slice_);
    slice_triangles_ += slice_.triangle_count();
    making_->drawn_triangles += slice_.triangle_count();
    KeyWork work;
    work.slot = making_->slot;
    if (!making_->is_begun) work.begin = &slots_[making_->slot].key.camera;
    making_->is_begun = true;
    work.slice = &slice_;
    work.error_px = slots_[making_->slot].key.error_px;
    work.is_last = making_->cut->is_done();
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

// Whether the camera has jumped.
bool Director::begin_frame(const view::Camera& camera) {
    is_begun_ = true;
    camera_ = camera;
    bool has_jumped = track_.add(camera);
    slice_triangles_ = 0;
    took_over_ = Cause::none;
    judge_keys();
    if (waiting_ && waiting_ != current_) take_over(*waiting_, reuse(*waiting_, camera_));
    waiting_.reset();
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
    if (!making_ && !is_key_begun()) return std::nullopt;
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
        if (current_ && spends_all())
            waiting_ = making_->slot;
        else
            take_over(making_->slot, made);
    }
    making_.reset();
}

// Of the coarse cut's triangles those all of whose corners are near come first.
void Director::put_near_first() {
    novel_.near_triangle_count = 0;
    if (novel_.near_depth_m <= 0) return;
    view::Axes axes = view::axes_of(camera_);
    far_indices_.clear();
    size_t kept = 0;
    for (size_t i = 0; i < low_.indices.size(); i += 3) {
        double farthest_m = 0;
        for (size_t j = i; j < i + 3; ++j) {
            glm::dvec3 away_m = refiner_.vertex_m(low_, low_.indices[j]) - camera_.position_m;
            farthest_m = std::max(farthest_m, glm::dot(away_m, axes.forward));
        }
        if (farthest_m < novel_.near_depth_m) {
            std::copy_n(&low_.indices[i], 3, &low_.indices[kept]);
            kept += 3;
        } else {
            far_indices_.insert(far_indices_.end(), &low_.indices[i], &low_.indices[i] + 3);
        }
    }
    std::copy(far_indices_.begin(), far_indices_.end(), low_.indices.begin() + ptrdiff_t(kept));
    novel_.near_triangle_count = kept / 3;
}

bool Director::shows_key() const {
    return current_ && current_reuse_.lost_share() <= kMostLost;
}

// As things are now; made again, coarser, where a budget does not allow so many triangles.
void Director::cut_coarse() {
    constexpr int kMostTries = 4;
    bool has_key = shows_key(), fits = false;
    novel_.near_depth_m = 0;
    novel_.finer_outside.reset();
    if (has_key && current_reuse_.outside_share > 0) novel_.finer_outside = slots_[*current_].key.camera;
    if (has_key && settings_.draws_near) {
        double most_growth = std::max(1.1, settings_.most_magnified * settings_.scale);
        novel_.near_depth_m = track_.speed_m() * life_frames_ / (most_growth - 1);
    }
    for (int tries = 0; tries < kMostTries && !fits; ++tries) {
        double coarser = spending_.coarser(has_key);
        novel_.near_error_px = settings_.error_px * coarser;
        novel_.low_error_px = has_key ? settings_.low_error_px * coarser : novel_.near_error_px;
        refiner_.cut_by_pixels(
            camera_, {novel_.low_error_px, settings_.morph, novel_.near_depth_m, novel_.near_error_px, novel_.finer_outside},
            low_);
        fits = spending_.coarse_done(has_key, low_.triangle_count());
    }
}

const Novel& Director::novel() {
    is_begun_ = false;
    ++age_frames_;
    novel_.keys.clear();
    novel_.rekeyed = took_over_;
    // Within a budget the cut is there, unless another key has taken over since.
    if (!is_cut_) cut_coarse();
    is_cut_ = false;
    put_near_first();
    bool has_key = shows_key();
    novel_.error_p99_px = has_key ? current_reuse_.drawn_p99_px : novel_.near_error_px;
    novel_.error_max_px = has_key ? current_reuse_.drawn_max_px : novel_.near_error_px;
    if (novel_.near_error_px > settings_.error_px && novel_.near_triangle_count > 0) {
        novel_.error_p99_px = std::max(novel_.error_p99_px, novel_.near_error_px);
        novel_.error_max_px = std::max(novel_.error_max_px, novel_.near_error_px);
    }
    novel_.lost_share = has_key ? current_reuse_.lost_share() : 1;
    novel_.is_fine = !has_key;
    if (has_key) {
        double fade = settings_.fade_frames > 0 ? double(fade_left_) / settings_.fade_frames : 0;
        novel_.keys.push_back({*current_, std::max(1 - fade, kFillWeight)});
        bool fills = fade_left_ > 0 || current_reuse_.lost_share() > kFillWorth;
        if (before_ && slots_[*before_].is_whole && fills) novel_.keys.push_back({*before_, std::max(fade, kFillWeight)});
        if (fade_left_ > 0) --fade_left_;
    }
    novel_.cut = &low_;
    return novel_;
}

}  // namespace overlook::lod_sprite
