// When a key is made, for which pose and in what slices, and which keys a frame looks into. No OpenGL here: a plan comes out.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/lod_sprite/geometry.h"
#include "runtime/lod_sprite/pose_track.h"
#include "runtime/lod_sprite/reuse.h"
#include "runtime/lod_sprite/shown.h"
#include "runtime/lod_sprite/spending.h"

namespace overlook::lod_sprite {

enum class KeyMode {
    at_once,  // in the frame that needs it, for that frame's own pose
    thread,   // beside the frames, by another thread, for a predicted pose; kThreadFrames later it is there, or is waited for
    sliced,   // over the frames before, for a predicted pose
};

// A key begun beside frame n is looked into from frame n + kThreadFrames on, however long it took.
constexpr uint32_t kThreadFrames = 8;

struct Settings {
    double error_px = 1;       // the promise of keys' cut; they show it as far as their texels can (Director::key_cut_px)
    double low_error_px = 16;  // of the coarse cut of novel frames
    // A new key is due where the p99 of the bounded error passes this; keys promise 2/3 of it. A frame's own geometry keeps it
    // where no key shows what is there (or error_px, where that is more, but not more than low_error_px).
    double key_error_px = 1;
    double most_grown = 1.6;  // or the p99 of how many times as wide a texel has become, > 1: more is seen to be blurred
    double guard = 1.15;
    uint32_t scale = 2;         // texels of a key a pixel, in both directions
    double texel_share = 0.25;  // keys keep no finer promise than so much of a texel, which could not show it; 0 = error_px
    // Keys kept, the one being made among them; at least 2. Of 2 a new one takes the place of the one that is left, which is then
    // gone at once if it was still fading out; from 3 on none that serves is broken off.
    uint32_t slots = 4;
    uint32_t most_slices = 48;
    uint32_t fade_frames = 8;  // over which a new key takes over from the old; 0 = at once
    double morph = 0;          // of the coarse cut (view::PixelDetail)
    KeyMode mode = KeyMode::sliced;
    bool keeps_outlines = true;  // of things whose coarse cut is not raised: refined along them (view::PixelDetail)
    bool closes_open = true;     // what no key is proven to show is drawn finer than the coarse cut (shown.h)
    bool draws_near = true;      // what keys could not serve for their life is drawn as geometry
    // That a frame may draw, those into keys included (of sliced keys: spending.h); 0 = as many as its errors take.
    double triangles = 0;

    double most_texel_px() const { return most_grown / scale; }  // of a frame
};

// Why a key is made.
enum class Cause { none, first, jump, error, magnified, turned };

// What is to be drawn into a key before the novel frame.
struct KeyWork {
    uint32_t slot = 0;
    const view::Camera* begin = nullptr;  // not null: the slot is emptied for this camera first
    std::optional<CutCount> slice;        // the geometry's slice is to be added; none where another thread is to draw the whole
    double error_px = 0;                  // what the key's whole cut promises its camera
    bool is_last = false;                 // the key is whole then, or to be waited for; Director::key_done() is to be told
};

struct NovelUse {
    uint32_t slot = 0;
    double weight = 1;
};

// What a novel frame is made of.
struct Novel {
    CutCount cut;                      // the geometry's coarse cut
    uint64_t near_triangle_count = 0;  // its first so many lie nearer than near_depth_m all through
    std::vector<NovelUse> keys;
    double near_depth_m = 0;
    double own_weight = 0;                        // of the surface's own colours, where the first key alone shows a pixel
    double low_error_px = 16, near_error_px = 1;  // what the cut keeps: of what is farther, and nearer
    std::optional<view::Camera> finer_outside;    // the cut keeps near_error_px outside what this one sees as well
    view::PictureMask finer_in;                   // and in these parts of the picture
    bool is_fine = false;                         // the cut keeps error_px everywhere: no key is there to be used
    double error_p99_px = 0, error_max_px = 0;    // bounded, over the pixels
    double lost_share = 0;                        // predicted
    Cause rekeyed = Cause::none;                  // why the key that took over with this frame was made
};

class Director {
  public:
    // The geometry must outlive it, and be cut by nobody else.
    Director(Geometry& geometry, const Settings& settings);

    // Each frame: key_work() until it gives none, each carried out at once; then novel(). It gives one at most, unless a budget
    // leaves triangles for the next key as well. The camera's size must stay the same, or forget() be called. The pointers hold
    // until the next call.
    std::optional<KeyWork> key_work(const view::Camera& camera);
    // triangle_count: of a key that another thread drew.
    void key_done(DepthGrid depths, uint64_t triangle_count = 0);
    const Novel& novel();
    const view::Camera& camera() const { return camera_; }  // of the frame, its near plane as the geometry has it
    void forget();
    // From the next frame on, instead of Settings::triangles.
    void set_triangles(double triangles) { spending_.set_triangles(triangles); }

    const Settings& settings() const { return settings_; }
    // What keys promise at their own pose: error_px, or texel_share of a texel where that is more.
    double key_cut_px() const;
    uint64_t keys_made() const { return keys_made_; }
    uint64_t key_triangles() const { return slice_triangles_; }  // of this frame's key work

  private:
    static constexpr double kMostLost = 0.3;  // of the frame: a key that has less to show is not looked into

    struct Slot {
        bool is_whole = false, is_fresh = false;  // fresh: no frame looked into it yet
        Key key;
        Cause cause = Cause::none;
        uint64_t triangle_count = 0;
    };
    struct Making {
        uint32_t slot = 0;
        Cause cause = Cause::none;
        bool is_begun = false;
        uint64_t drawn_triangles = 0;
        uint32_t frames_to_go = 1;
    };

    void judge_keys();
    void take_over(uint32_t slot);
    void drop_wrong_key(bool has_jumped);
    bool is_key_begun();
    std::optional<KeyWork> slice_work();
    std::optional<KeyWork> thread_work();
    Reuse reuse(uint32_t slot, const view::Camera& camera, const Shown* shown = nullptr) const;
    Shown shown(uint32_t slot) const { return shown_by(slots_[slot].key, camera_, settings_.most_texel_px()); }
    void use(uint32_t slot);
    bool has_before() const { return before_ && slots_[*before_].is_whole; }
    view::PictureMask open_parts() const;
    double most_error_px() const;
    double fine_error_px() const;
    bool spends_all() const;
    uint32_t frames_to_make(uint32_t left);
    bool serves(const Reuse& reuse) const;
    bool is_fading() const;
    bool is_served(const view::Camera& camera) const;
    bool may_rest() const;
    uint32_t frames_left() const;
    Cause cause_now() const;
    void begin_key(const view::Camera& pose, Cause cause);
    // For one more key beside those in use, the one that is left among them.
    bool has_room() const { return slots_.size() > (waiting_ ? 3u : 1u); }
    uint32_t slot_to_empty() const;
    uint64_t slice_triangles();
    bool shows_key() const;
    void cut_coarse();
    bool begin_frame(const view::Camera& camera);

    Geometry& geometry_;
    Settings settings_;
    Spending spending_;
    PoseTrack track_;
    view::Camera camera_;
    bool is_begun_ = false, is_cut_ = false;  // this frame
    std::vector<Slot> slots_;
    std::optional<uint32_t> current_, before_;  // the key in use, and the one that it fades in over
    std::optional<uint32_t> waiting_;           // a whole one that takes over with the next frame that does not fade
    uint32_t fade_left_ = 0;
    std::optional<Making> making_;
    Reuse current_reuse_;
    Shown current_shown_;
    uint64_t expected_triangles_ = 0;  // of a key
    double life_frames_ = 16;          // of keys lately
    uint32_t age_frames_ = 0;          // of the one in use
    bool has_taken_over_ = false;
    uint64_t keys_made_ = 0, slice_triangles_ = 0;
    bool has_drawn_ = false;  // a frame since it forgot
    Cause took_over_ = Cause::none;
    Novel novel_;
};

}  // namespace overlook::lod_sprite
