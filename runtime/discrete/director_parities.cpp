// What of changes of level goes into even frames and what into odd ones, so that all take as much work.
#include <algorithm>
#include <cmath>

#include "runtime/discrete/director.h"

namespace overlook::discrete {
namespace {

constexpr double kUnevenShare = 0.01;  // of a frame's triangles, that even frames may draw more than odd ones or fewer
constexpr double kMostTwice = 0.25;    // of what is divided, drawn on both sides

// The picture's sides and the plane that divides a thing, the one side of it or the other.
std::array<glm::dvec3, 5> with_side(const std::array<glm::dvec3, 4>& sides, const glm::dvec3& normal, bool is_along) {
    return {sides[0], sides[1], sides[2], sides[3], is_along ? normal : -normal};
}

}  // namespace

int64_t Director::difference(uint32_t instance, const Transition& transition) const {
    if (auto found = partly_.find(instance); found != partly_.end()) return found->second.difference;
    return int64_t(facts_.levels[finer(transition)].triangle_count) - int64_t(facts_.levels[coarser(transition)].triangle_count);
}

uint64_t Director::triangles_seen(uint32_t instance, uint32_t level) const {
    const LevelFacts& facts = facts_.levels[level];
    if (!is_partly_seen(instance, level)) return facts.triangle_count;
    return seen_count(facts.bunches, placements_[instance], eye_m_, sides_);
}

// Of something under way that is not divided.
void Director::count_seen(uint32_t instance) {
    const Transition& transition = states_[instance].transition;
    bool is_partly = is_partly_seen(instance, finer(transition)) || is_partly_seen(instance, coarser(transition));
    if (is_partly)
        partly_[instance] = {
            {}, int64_t(triangles_seen(instance, finer(transition))) - int64_t(triangles_seen(instance, coarser(transition)))};
    else
        partly_.erase(instance);
}

// A plane that shares a thing out, if one does it well.
bool Director::divide(uint32_t instance) {
    const Placement& placement = placements_[instance];
    const Transition& transition = states_[instance].transition;
    const LevelFacts &fine = facts_.levels[finer(transition)], &coarse = facts_.levels[coarser(transition)];
    std::optional<Split> split =
        split_of(fine.bunches, coarse.bunches, placement, facts_.middle_m, facts_.radius_m, eye_m_, way_past(instance, way_m_), sides_);
    if (!split) return false;
    glm::dvec3 normal = turn_to_eye(*split, placement, eye_m_);
    auto count = [&](const LevelFacts& level, bool is_along) {
        return int64_t(seen_count(level.bunches, placement, eye_m_, with_side(sides_, normal, is_along)));
    };
    int64_t even = count(fine, true) + count(coarse, false), odd = count(fine, false) + count(coarse, true);
    auto all =
        int64_t(seen_count(fine.bunches, placement, eye_m_, sides_) + seen_count(coarse.bunches, placement, eye_m_, sides_));
    bool pays = std::abs(even - odd) < all / 4 && double(even + odd - all) <= kMostTwice * double(all);
    if (pays) partly_[instance] = {split, even - odd};
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
        count_seen(instance);
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

// Each level on its side; which of the two is the even frames', is_odd says.
void Director::list_divided(uint32_t instance, const State& state, Partly& partly, double grain) {
    const Transition& transition = state.transition;
    const Placement& placement = placements_[instance];
    glm::dvec3 normal = turn_to_eye(*partly.split, placement, eye_m_);
    uint32_t fine = finer(transition), along = drawn_level(state);
    auto add = [&](uint32_t level, bool is_along) {
        Item item{instance, level, Show::visible, visible_share(transition, level), fine, grain};
        item.side = is_along ? Item::Side::along : Item::Side::against, item.normal = normal;
        item.first_run = uint32_t(frame_.runs.size());
        uint64_t count =
            append_seen(facts_.levels[level].bunches, placement, eye_m_, with_side(sides_, normal, is_along), frame_.runs);
        item.run_count = uint32_t(frame_.runs.size()) - item.first_run;
        if (item.run_count > 0) frame_.items.push_back(item);
        return int64_t(count);
    };
    uint32_t against = along == fine ? coarser(transition) : fine;
    int64_t now = add(along, true) + add(against, false);
    auto count = [&](uint32_t level, bool is_along) {
        return int64_t(seen_count(facts_.levels[level].bunches, placement, eye_m_, with_side(sides_, normal, is_along)));
    };
    int64_t next = count(against, true) + count(along, false);
    partly.difference = along == fine ? now - next : next - now;
}

int64_t Director::balance() const {
    int64_t balance = 0;
    for (uint32_t i = 0; i < states_.size(); ++i) {
        const State& state = states_[i];
        if (!state.transition.is_resting()) balance += (state.is_odd ? -1 : 1) * difference(i, state.transition);
    }
    return balance;
}

}  // namespace overlook::discrete
