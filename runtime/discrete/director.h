// Decides, frame by frame, which levels of which instances are drawn, and how.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "runtime/discrete/demand.h"
#include "runtime/discrete/foresight.h"
#include "runtime/discrete/select.h"
#include "runtime/discrete/settings.h"
#include "runtime/discrete/transition.h"
#include "runtime/view/camera.h"

namespace overlook::discrete {

// How an item is drawn.
enum class Show : uint32_t {
    whole,
    visible,       // where the visibility of its change of level is at most `share`
    dithered_in,   // on the share of the pixels that a screen door opens first
    dithered_out,  // on the others, or on those of them that it opens next
    translucent,   // mixed over what is behind, with this share
};

// One level of one instance.
struct Item {
    uint32_t instance = 0, level = 0;
    Show show = Show::whole;
    double share = 1;     // 0..1
    uint32_t change = 0;  // whose visibility: that of the change between this level and the next coarser
    double grain = 1;     // times as wide as the visibility's own
    // Drawn on one side of a plane through the eye alone.
    enum class Side : uint32_t { whole, along, against } side = Side::whole;
    glm::dvec3 normal{0};  // of the plane, in the world
    // Of the level runs [first_run, + run_count) of FrameList::runs; if none: all of it.
    uint32_t first_run = 0, run_count = 0;
    double up_to = 1;  // of dithered_out: on the pixels that the door opens from share up to here

    bool operator==(const Item&) const = default;
};

// An instance on its way between two levels, in view.
struct Fading {
    uint32_t instance = 0;
    Transition transition;
    uint32_t drawn_level = 0;  // by this frame; of methods that draw by turns; of one that is divided: along its normal
};

// What one frame draws and what it did.
struct FrameList {
    std::vector<Item> items;        // by level, those of a level one after the other, front to back
    std::vector<Item> translucent;  // over them, back to front
    std::vector<Fading> fading;     // by instance
    std::vector<TriangleRun> runs;  // of items that are divided, or cut by the picture's sides
    uint64_t triangle_count = 0;
    uint64_t settled_triangle_count = 0;  // as if the changes of level under way were over
    uint64_t tested_count = 0;            // instances looked at
    uint64_t in_view_count = 0;           // of them
    uint64_t begun_count = 0;             // changes of level begun, turned or done at once, in view
    double error_px = 0;                  // the greatest bound of what is drawn and not only hidden, against level 0
};

// All that is in view at its finest level: what there is to compare with.
FrameList finest_frame(const ChainFacts& facts, std::span<const Placement> placements, const view::Camera& camera);

// The state of all instances from frame to frame. Same frames, same lists.
class Director {
  public:
    Director(ChainFacts facts, std::span<const Placement> placements, const FrameOptions& options);

    // They stand elsewhere from the next frame on. placements: as many as before.
    void place(std::span<const Placement> placements);
    // One frame. Before the first, and out of view, levels are as wanted at once. dt_s >= 0: since the last frame.
    void decide(const view::Camera& camera, double dt_s);
    // The same of one of several directors in a picture. balance: the sum of all their balances before the frame; goes on with
    // what begins here.
    void decide(const view::Camera& camera, double dt_s, int64_t& balance);
    // Triangles that even frames draw more than odd ones, of the changes under way. O(instances).
    int64_t balance() const;
    // Keeps levels and transitions; if the variant does not fade they end.
    void change(const FrameOptions& options);
    // From the next frame on levels do that are so many times as coarse as the options ask (discrete::coarser). times > 0.
    void coarsen(double times) { times_ = times; }
    // What such a frame would take, whatever coarsen() says; asked before decide() of the same camera and dt_s. O(instances in
    // view x levels).
    Demand demand(const view::Camera& camera, double dt_s) const;

    const FrameList& frame() const { return frame_; }
    const FrameOptions& options() const { return options_; }
    const ChainFacts& facts() const { return facts_; }
    const std::vector<Placement>& placements() const { return placements_; }
    const Transition& transition(uint32_t instance) const { return states_[instance].transition; }
    // How wide the visibility's grain is, in metres at scale 1: the period over the picture's width. 0: unknown.
    void set_grain_m(std::vector<double> of_change) { grain_m_ = std::move(of_change); }
    size_t bytes() const { return states_.size() * sizeof(State) + placements_.size() * sizeof(Placement); }

  private:
    struct State {
        Transition transition;
        bool is_known = false;  // has been looked at
        bool was_in_view = false;
        bool is_odd = false;  // draws its finer level in odd frames
        bool is_cut = false;  // by the picture's sides
        uint8_t grain_doublings = 0;
    };
    // A change of level of which not all is drawn in each frame: divided, or of something that the picture's sides cut; and what
    // its even frames draw more than its odd ones if it is not odd.
    struct Partly {
        std::optional<Split> split;
        int64_t difference = 0;
    };
    bool advance(uint32_t instance, State& state, const Placement& placement, const Selector& selector, double dt_s,
                 bool is_in_view);
    view::Camera camera_later(Foresight& foresight, const view::Camera& camera, double dt_s) const;
    glm::dvec3 way_to(const view::Camera& camera) const;
    glm::dvec3 way_past(uint32_t instance, const glm::dvec3& way_m) const;
    bool knows_cuts() const;
    // Whether its level is to be chosen as if it had none: never looked at, or the eye came from elsewhere.
    bool begins_anew(uint32_t instance, const glm::dvec3& eye_m, const glm::dvec3& way_m) const;
    void suit_grain(State& state, const Placement& placement, const Selector& selector) const;
    bool is_partly_seen(uint32_t instance, uint32_t level) const;
    void add(Item item, std::vector<Item>& to);
    void list(uint32_t instance, const State& state, const Selector& selector);
    void sort_items();
    void count_settled(std::span<const uint32_t> in_view);
    uint32_t drawn_level(const State& state) const;
    // What goes into even frames and what into odd ones (director_parities.cpp).
    void begin(const Selector& selector);
    void take_side(uint32_t instance);
    bool divide(uint32_t instance);
    void count_seen(uint32_t instance);
    void list_divided(uint32_t instance, const State& state, Partly& partly, double grain);
    uint64_t triangles_seen(uint32_t instance, uint32_t level) const;
    int64_t difference(uint32_t instance, const Transition& transition) const;

    ChainFacts facts_;
    std::vector<Placement> placements_;
    FrameOptions options_;
    std::vector<State> states_;
    std::vector<double> grain_m_;
    FrameList frame_;
    Foresight foresight_;
    std::vector<Placement> placed_before_;  // in the frame before, if they stood elsewhere
    std::map<uint32_t, Partly> partly_;     // by instance
    std::array<glm::dvec3, 4> sides_{};     // of the picture, inwards
    std::vector<uint32_t> begun_;           // this frame, in view: instances
    uint64_t frame_count_ = 0;
    uint64_t last_triangle_count_ = 0;  // of the frame before
    glm::dvec3 eye_m_{0}, way_m_{0};    // of the camera, and where it came from the frame before
    int64_t balance_ = 0;               // of the picture, while a frame is decided
    double times_ = 1;                  // as coarsen()
};

}  // namespace overlook::discrete
