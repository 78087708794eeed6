#include "runtime/discrete/director.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace overlook::discrete {
namespace {

constexpr uint8_t kMostGrainDoublings = 20;
constexpr double kUnevenShare = 0.01;  // of a frame's triangles, that even frames may draw more than odd ones or fewer
constexpr double kCutShare = 0.25;     // of a thing's distance: an eye that went farther in a frame was put elsewhere
constexpr double kMostTwice = 0.25;    // of what is divided, drawn on both sides

uint32_t finer(const Transition& transition) {
    return std::min(transition.from, transition.to);
}
uint32_t coarser(const Transition& transition) {
    return std::max(transition.from, transition.to);
}

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
    divided_.clear();
}

int64_t Director::difference(uint32_t instance, const Transition& transition) const {
    if (auto found = divided_.find(instance); found != divided_.end()) return found->second.difference;
    return int64_t(facts_.levels[finer(transition)].triangle_count) - int64_t(facts_.levels[coarser(transition)].triangle_count);
}

// The eye's way since the frame before as the thing sees it, which may have moved itself.
glm::dvec3 Director::way_past(uint32_t instance) const {
    if (placed_before_.empty()) return way_m_;
    return way_m_ - (placements_[instance].at(facts_.middle_m) - placed_before_[instance].at(facts_.middle_m));
}

// From so far apart it is another picture of the thing, and the level in use may be far too coarse.
bool Director::is_cut(uint32_t instance) const {
    const Placement& placement = placements_[instance];
    double distance_m = glm::length(placement.at(facts_.middle_m) - eye_m_);
    return glm::length(way_past(instance)) > kCutShare * std::max(distance_m, facts_.radius_m * placement.scale);
}

// A plane that shares a thing out, if one does it well.
bool Director::divide(uint32_t instance) {
    const Placement& placement = placements_[instance];
    const Transition& transition = states_[instance].transition;
    const LevelFacts &fine = facts_.levels[finer(transition)], &coarse = facts_.levels[coarser(transition)];
    std::optional<Split> split = split_of(fine.bunches, coarse.bunches, placement, facts_.middle_m, facts_.radius_m, eye_m_,
                                          way_past(instance));
    if (!split) return false;
    glm::dvec3 normal = turn_to_eye(*split, placement, eye_m_);
    std::vector<TriangleRun> runs;
    auto count = [&](const LevelFacts& level, bool is_along) {
        return int64_t(append_side(level.bunches, placement, eye_m_, normal, is_along, runs));
    };
    int64_t even = count(fine, true) + count(coarse, false), odd = count(fine, false) + count(coarse, true);
    auto all = int64_t(fine.triangle_count + coarse.triangle_count);
    bool pays = std::abs(even - odd) < all / 4 && double(even + odd - all) <= kMostTwice * double(all);
    if (pays) divided_[instance] = {*split, even - odd};
    return pays;
}

// It draws more where less is drawn.
void Director::take_side(uint32_t instance) {
    State& state = states_[instance];
    int64_t more = difference(instance, state.transition);
    state.is_odd = more < 0 ? balance_ < 0 : balance_ > 0;
    balance_ += (state.is_odd ? -1 : 1) * more;
}

// As printed, all instances change their level with the frame; else those that begin go where fewer triangles are, and what they
// leave uneven is divided, the last first.
void Director::begin(const Selector& selector) {
    bool is_own = options_.variant == Variant::fsi, splits = is_own && options_.remedies.splits_parities;
    for (uint32_t instance : begun_) {
        states_[instance].is_odd = false;
        if (splits) take_side(instance);
    }
    bool divides = splits && options_.remedies.splits_things;
    for (size_t i = begun_.size(); i-- > 0 && divides;) {
        if (double(std::abs(balance_)) <= kUnevenShare * double(last_triangle_count_)) break;
        uint32_t instance = begun_[i];
        const State& state = states_[instance];
        int64_t own = (state.is_odd ? -1 : 1) * difference(instance, state.transition);
        if (std::abs(balance_ - own) >= std::abs(balance_) || !divide(instance)) continue;
        balance_ -= own;
        take_side(instance);
    }
    for (uint32_t instance : begun_) {
        State& state = states_[instance];
        // Nothing is seen of a change before the new level is drawn; and what begins together ends together, shared out evenly.
        if (is_own) state.transition.phase = 0;
        suit_grain(state, placements_[instance], selector);
    }
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
    bool was_in_view = std::exchange(state.was_in_view, is_in_view);
    if (!state.is_known) {
        uint32_t level = selector.wanted(placement);
        state.transition = {level, level, 0};
        state.is_known = true;
        return false;
    }
    bool knows_cuts = options_.variant == Variant::fsi && options_.remedies.knows_cuts;
    bool has_cut = knows_cuts && is_cut(instance);
    uint32_t wanted = has_cut ? selector.wanted(placement) : selector.wanted(placement, before.to);
    if (!fades(options_.variant) || !is_in_view || has_cut || (knows_cuts && !was_in_view)) {
        state.transition = {wanted, wanted, 0};
        divided_.erase(instance);
        return wanted != before.to;
    }
    state.transition = step(before, wanted, dt_s, options_.fade_s, options_.is_one_by_one);
    const Transition& after = state.transition;
    if (after.is_resting()) divided_.erase(instance);
    if (before.is_resting() && !after.is_resting()) begun_.push_back(instance);
    bool has_turned = !before.is_resting() && after.to == before.from;
    return (before.is_resting() && after.to != before.to) || has_turned;
}

uint32_t Director::drawn_level(const State& state) const {
    bool is_finer = (frame_count_ % 2 == 1) == state.is_odd;
    return is_finer ? finer(state.transition) : coarser(state.transition);
}

// Each level on its side; which of the two is the even frames', is_odd says.
void Director::list_divided(uint32_t instance, const State& state, Divided& divided, double grain) {
    const Transition& transition = state.transition;
    const Placement& placement = placements_[instance];
    glm::dvec3 normal = turn_to_eye(divided.split, placement, eye_m_);
    uint32_t fine = finer(transition), along = drawn_level(state);
    auto add = [&](uint32_t level, bool is_along) {
        Item item{instance, level, Show::visible, visible_share(transition, level), fine, grain};
        item.side = is_along ? Item::Side::along : Item::Side::against, item.normal = normal;
        item.first_run = uint32_t(frame_.runs.size());
        uint64_t count = append_side(facts_.levels[level].bunches, placement, eye_m_, normal, is_along, frame_.runs);
        item.run_count = uint32_t(frame_.runs.size()) - item.first_run;
        if (item.run_count > 0) frame_.items.push_back(item);
        return int64_t(count);
    };
    uint32_t against = along == fine ? coarser(transition) : fine;
    int64_t now = add(along, true) + add(against, false);
    size_t run_count = frame_.runs.size();
    auto count = [&](uint32_t level, bool is_along) {
        return int64_t(append_side(facts_.levels[level].bunches, placement, eye_m_, normal, is_along, frame_.runs));
    };
    int64_t next = count(against, true) + count(along, false);
    frame_.runs.resize(run_count);
    divided.difference = along == fine ? now - next : next - now;
}

void Director::list(uint32_t instance, const State& state, const Selector& selector) {
    const Transition& transition = state.transition;
    const Placement& placement = placements_[instance];
    if (transition.is_resting()) {
        frame_.items.push_back({instance, transition.to, Show::whole, 1, 0, 1});
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
            if (auto found = divided_.find(instance); found != divided_.end()) {
                list_divided(instance, state, found->second, grain);
                break;
            }
            double share = visible_share(transition, fading.drawn_level);
            frame_.items.push_back({instance, fading.drawn_level, Show::visible, share, change, grain});
            break;
        }
        case Variant::dither:
            frame_.items.push_back({instance, transition.to, Show::dithered_in, transition.phase, change, 1});
            frame_.items.push_back({instance, transition.from, Show::dithered_out, transition.phase, change, 1});
            break;
        default: {
            bool is_new_whole = share_of_new >= 1;
            uint32_t whole = is_new_whole ? transition.to : transition.from;
            uint32_t other = is_new_whole ? transition.from : transition.to;
            frame_.items.push_back({instance, whole, Show::whole, 1, change, 1});
            frame_.translucent.push_back({instance, other, Show::translucent, std::min(share_of_new, share_of_old), change, 1});
        }
    }
    frame_.fading.push_back(fading);
}

void Director::sort_items() {
    std::stable_sort(frame_.items.begin(), frame_.items.end(), [](const Item& a, const Item& b) { return a.level < b.level; });
    for (const Item& item : frame_.items) {
        if (item.side == Item::Side::whole) frame_.triangle_count += facts_.levels[item.level].triangle_count;
    }
    for (const TriangleRun& run : frame_.runs) frame_.triangle_count += run.index_count / 3;
    for (const Item& item : frame_.translucent) frame_.triangle_count += facts_.levels[item.level].triangle_count;
}

int64_t Director::balance() const {
    int64_t balance = 0;
    for (uint32_t i = 0; i < states_.size(); ++i) {
        const State& state = states_[i];
        if (!state.transition.is_resting()) balance += (state.is_odd ? -1 : 1) * difference(i, state.transition);
    }
    return balance;
}

void Director::decide(const view::Camera& camera, double dt_s) {
    int64_t alone = balance();
    decide(camera, dt_s, alone);
}

void Director::decide(const view::Camera& camera, double dt_s, int64_t& balance) {
    // A change that begins with the next frame ends a frame later.
    double horizon_s = options_.fade_s + 2 * dt_s;
    view::Camera later = foresight_.ahead(camera, dt_s, options_.fade_s, horizon_s);
    Selector ahead(facts_, options_.select, later);
    bool foresees = fades(options_.variant) && options_.foresees;
    Selector selector(facts_, options_.select, camera, foresees ? &ahead : nullptr);
    last_triangle_count_ = frame_.triangle_count;
    way_m_ = frame_count_ > 0 ? camera.position_m - eye_m_ : glm::dvec3(0);
    eye_m_ = camera.position_m;
    frame_ = {};
    ++frame_count_;
    balance_ = balance;
    begun_.clear();
    std::vector<uint32_t> in_view;
    for (uint32_t instance = 0; instance < states_.size(); ++instance) {
        bool is_in_view = selector.is_in_view(placements_[instance]);
        bool has_begun = advance(instance, states_[instance], placements_[instance], selector, dt_s, is_in_view);
        if (!is_in_view) continue;
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
    auto depth_m = [&](const Item& item) {
        glm::dvec3 from_eye_m = placements_[item.instance].at(facts_.middle_m) - camera.position_m;
        return glm::dot(from_eye_m, from_eye_m);
    };
    std::stable_sort(frame_.translucent.begin(), frame_.translucent.end(),
                     [&](const Item& a, const Item& b) { return depth_m(a) > depth_m(b); });
}

}  // namespace overlook::discrete
