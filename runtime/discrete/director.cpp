#include "runtime/discrete/director.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace overlook::discrete {
namespace {

constexpr uint8_t kMostGrainDoublings = 20;
constexpr double kCutShare = 0.25;  // of a thing's distance: an eye that went farther in a frame was put elsewhere

}  // namespace

FrameList finest_frame(const ChainFacts& facts, std::span<const Placement> placements, const view::Camera& camera) {
    Selector selector(facts, {}, camera);
    FrameList frame;
    frame.tested_count = placements.size();
    for (uint32_t instance = 0; instance < placements.size(); ++instance) {
        if (selector.is_in_view(placements[instance])) frame.items.push_back({instance, 0, Show::whole, 1, 0, 1});
    }
    frame.in_view_count = frame.items.size();
    frame.triangle_count = frame.items.size() * facts.levels[0].triangle_count;
    return frame;
}

Director::Director(ChainFacts facts, std::span<const Placement> placements, const FrameOptions& options)
    : facts_(std::move(facts)),
      placements_(placements.begin(), placements.end()),
      options_(options),
      states_(placements.size()) {}

void Director::place(std::span<const Placement> placements) {
    assert(placements.size() == placements_.size());
    if (placed_before_.empty()) placed_before_ = placements_;
    placements_.assign(placements.begin(), placements.end());
}

void Director::change(const FrameOptions& options) {
    options_ = options;
    if (fades(options.variant)) return;
    for (State& state : states_) state.transition = {state.transition.to, state.transition.to, 0};
    partly_.clear();
}

// The eye's way since the frame before as the thing sees it, which may have moved itself.
glm::dvec3 Director::way_past(uint32_t instance, const glm::dvec3& way_m) const {
    if (placed_before_.empty()) return way_m;
    return way_m - (placements_[instance].at(facts_.middle_m) - placed_before_[instance].at(facts_.middle_m));
}

bool Director::knows_cuts() const {
    return options_.variant == Variant::fsi && options_.remedies.knows_cuts;
}

// From so far apart it is another picture of the thing, and the level in use may be far too coarse.
bool Director::begins_anew(uint32_t instance, const glm::dvec3& eye_m, const glm::dvec3& way_m) const {
    if (!states_[instance].is_known) return true;
    if (!knows_cuts()) return false;
    const Placement& placement = placements_[instance];
    double distance_m = glm::length(placement.at(facts_.middle_m) - eye_m);
    return glm::length(way_past(instance, way_m)) > kCutShare * std::max(distance_m, facts_.radius_m * placement.scale);
}

glm::dvec3 Director::way_to(const view::Camera& camera) const {
    return frame_count_ > 0 ? camera.position_m - eye_m_ : glm::dvec3(0);
}

// A change that begins with the next frame ends a frame later.
view::Camera Director::camera_later(Foresight& foresight, const view::Camera& camera, double dt_s) const {
    return foresight.ahead(camera, dt_s, options_.fade_s, options_.fade_s + 2 * dt_s);
}

Demand Director::demand(const view::Camera& camera, double dt_s) const {
    Foresight foresight = foresight_;
    Selector ahead(facts_, options_.select, camera_later(foresight, camera, dt_s));
    bool foresees = fades(options_.variant) && options_.foresees;
    Selector selector(facts_, options_.select, camera, foresees ? &ahead : nullptr);
    glm::dvec3 way_m = way_to(camera);
    Demand demand(facts_, options_.select);
    for (uint32_t instance = 0; instance < states_.size(); ++instance) {
        if (!selector.is_in_view(placements_[instance])) continue;
        std::optional<uint32_t> in_use;
        if (!begins_anew(instance, camera.position_m, way_m)) in_use = states_[instance].transition.to;
        demand.add(selector, placements_[instance], in_use, camera);
    }
    return demand;
}

void Director::suit_grain(State& state, const Placement& placement, const Selector& selector) const {
    state.grain_doublings = 0;
    uint32_t change = finer(state.transition);
    bool suits = options_.variant == Variant::fsi && options_.remedies.suits_grain;
    if (!suits || change >= grain_m_.size() || grain_m_[change] <= 0) return;
    double doublings = std::ceil(std::log2(selector.pixel_m(placement) / (grain_m_[change] * placement.scale)));
    state.grain_doublings = uint8_t(std::clamp(doublings, 0.0, double(kMostGrainDoublings)));
}

// Returns whether a change of level begins, turns or is done at once.
bool Director::advance(uint32_t instance, State& state, const Placement& placement, const Selector& selector, double dt_s,
                       bool is_in_view) {
    Transition before = state.transition;
    bool was_in_view = std::exchange(state.was_in_view, is_in_view), is_anew = begins_anew(instance, eye_m_, way_m_);
    if (!state.is_known) {
        uint32_t level = selector.wanted(placement);
        state.transition = {level, level, 0};
        state.is_known = true;
        return false;
    }
    uint32_t wanted = is_anew ? selector.wanted(placement) : selector.wanted(placement, before.to);
    if (!fades(options_.variant) || !is_in_view || is_anew || (knows_cuts() && !was_in_view)) {
        state.transition = {wanted, wanted, 0};
        partly_.erase(instance);
        return wanted != before.to;
    }
    state.transition = step(before, wanted, dt_s, options_.fade_s, options_.is_one_by_one);
    const Transition& after = state.transition;
    if (after.is_resting()) partly_.erase(instance);
    if (before.is_resting() && !after.is_resting()) begun_.push_back(instance);
    bool has_turned = !before.is_resting() && after.to == before.from;
    return (before.is_resting() && after.to != before.to) || has_turned;
}

uint32_t Director::drawn_level(const State& state) const {
    bool is_finer = (frame_count_ % 2 == 1) == state.is_odd;
    return is_finer ? finer(state.transition) : coarser(state.transition);
}

bool Director::is_partly_seen(uint32_t instance, uint32_t level) const {
    const LevelFacts& facts = facts_.levels[level];
    return states_[instance].is_cut && is_drawn_in_part(facts);
}

// Of something large that the picture's sides cut, only what is seen.
void Director::add(Item item, std::vector<Item>& to) {
    if (is_partly_seen(item.instance, item.level)) {
        item.first_run = uint32_t(frame_.runs.size());
        append_seen(facts_.levels[item.level].bunches, placements_[item.instance], eye_m_, sides_, frame_.runs);
        item.run_count = uint32_t(frame_.runs.size()) - item.first_run;
        if (item.run_count == 0) return;
    }
    to.push_back(item);
}

void Director::list(uint32_t instance, const State& state, const Selector& selector) {
    const Transition& transition = state.transition;
    const Placement& placement = placements_[instance];
    if (transition.is_resting()) {
        add({instance, transition.to, Show::whole, 1, 0, 1}, frame_.items);
        frame_.error_px = std::max(frame_.error_px, selector.error_px(placement, transition.to));
        return;
    }
    frame_.error_px = std::max(frame_.error_px, selector.error_px(placement, coarser(transition)));
    Fading fading{instance, transition, 0};
    uint32_t change = finer(transition);
    double grain = std::exp2(double(state.grain_doublings));
    double share_of_new = visible_share_of_new(transition.phase), share_of_old = visible_share_of_old(transition.phase);
    switch (options_.variant) {
        case Variant::fsi:
        case Variant::fsi_paper: {
            fading.drawn_level = drawn_level(state);
            if (auto found = partly_.find(instance); found != partly_.end() && found->second.split) {
                list_divided(instance, state, found->second, grain);
                break;
            }
            count_seen(instance);
            double share = visible_share(transition, fading.drawn_level);
            add({instance, fading.drawn_level, Show::visible, share, change, grain}, frame_.items);
            break;
        }
        case Variant::dither:
            add({instance, transition.to, Show::dithered_in, transition.phase, change, 1}, frame_.items);
            add({instance, transition.from, Show::dithered_out, transition.phase, change, 1}, frame_.items);
            break;
        default: {
            bool is_new_whole = share_of_new >= 1;
            uint32_t whole = is_new_whole ? transition.to : transition.from;
            uint32_t other = is_new_whole ? transition.from : transition.to;
            add({instance, whole, Show::whole, 1, change, 1}, frame_.items);
            add({instance, other, Show::translucent, std::min(share_of_new, share_of_old), change, 1}, frame_.translucent);
        }
    }
    frame_.fading.push_back(fading);
}

// What is near comes first, so that what lies behind it need not be shaded.
void Director::sort_items() {
    struct Place {
        uint32_t level = 0;
        float distance2_m2 = 0;
        uint32_t item = 0;
    };
    std::vector<Place> places;
    places.reserve(frame_.items.size());
    for (const Item& item : frame_.items) {
        glm::dvec3 from_eye_m = placements_[item.instance].at(facts_.middle_m) - eye_m_;
        places.push_back({item.level, float(glm::dot(from_eye_m, from_eye_m)), uint32_t(places.size())});
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::tie(a.level, a.distance2_m2, a.item) < std::tie(b.level, b.distance2_m2, b.item);
    });
    std::vector<Item> sorted;
    sorted.reserve(places.size());
    for (const Place& place : places) sorted.push_back(frame_.items[place.item]);
    frame_.items = std::move(sorted);
    for (const Item& item : frame_.items) {
        if (item.run_count == 0) frame_.triangle_count += facts_.levels[item.level].triangle_count;
    }
    for (const TriangleRun& run : frame_.runs) frame_.triangle_count += run.index_count / 3;
    for (const Item& item : frame_.translucent) {
        if (item.run_count == 0) frame_.triangle_count += facts_.levels[item.level].triangle_count;
    }
}

void Director::count_settled(std::span<const uint32_t> in_view) {
    frame_.settled_triangle_count = 0;
    for (const Item& item : frame_.items) {
        if (!states_[item.instance].transition.is_resting()) continue;
        if (item.run_count == 0) frame_.settled_triangle_count += facts_.levels[item.level].triangle_count;
        for (uint32_t i = 0; i < item.run_count; ++i)
            frame_.settled_triangle_count += frame_.runs[item.first_run + i].index_count / 3;
    }
    for (uint32_t instance : in_view) {
        const Transition& transition = states_[instance].transition;
        if (!transition.is_resting()) frame_.settled_triangle_count += triangles_seen(instance, transition.to);
    }
}

void Director::decide(const view::Camera& camera, double dt_s) {
    int64_t alone = balance();
    decide(camera, dt_s, alone);
}

void Director::decide(const view::Camera& camera, double dt_s, int64_t& balance) {
    SelectSettings select = coarser(options_.select, times_);
    Selector ahead(facts_, select, camera_later(foresight_, camera, dt_s));
    bool foresees = fades(options_.variant) && options_.foresees;
    Selector selector(facts_, select, camera, foresees ? &ahead : nullptr);
    last_triangle_count_ = frame_.triangle_count;
    way_m_ = way_to(camera);
    eye_m_ = camera.position_m, sides_ = view::sides_of(camera);
    frame_ = {};
    ++frame_count_;
    balance_ = balance;
    begun_.clear();
    std::vector<uint32_t> in_view;
    for (uint32_t instance = 0; instance < states_.size(); ++instance) {
        bool is_in_view = selector.is_in_view(placements_[instance]);
        bool has_begun = advance(instance, states_[instance], placements_[instance], selector, dt_s, is_in_view);
        if (!is_in_view) continue;
        states_[instance].is_cut = !selector.is_within_sides(placements_[instance]);
        frame_.begun_count += has_begun;
        in_view.push_back(instance);
    }
    begin(selector);
    for (uint32_t instance : in_view) list(instance, states_[instance], selector);
    frame_.in_view_count = in_view.size();
    placed_before_.clear();
    balance = balance_;
    frame_.tested_count = states_.size();
    sort_items();
    count_settled(in_view);
    auto depth_m = [&](const Item& item) {
        glm::dvec3 from_eye_m = placements_[item.instance].at(facts_.middle_m) - camera.position_m;
        return glm::dot(from_eye_m, from_eye_m);
    };
    std::stable_sort(frame_.translucent.begin(), frame_.translucent.end(),
                     [&](const Item& a, const Item& b) { return depth_m(a) > depth_m(b); });
}

}  // namespace overlook::discrete
