#include "runtime/discrete/director.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace overlook::discrete {
namespace {

constexpr uint8_t kMostGrainDoublings = 20;

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
    placements_.assign(placements.begin(), placements.end());
}

void Director::change(const FrameOptions& options) {
    options_ = options;
    if (fades(options.variant)) return;
    for (State& state : states_) state.transition = {state.transition.to, state.transition.to, 0};
}

int64_t Director::difference(const Transition& transition) const {
    return int64_t(facts_.levels[finer(transition)].triangle_count) - int64_t(facts_.levels[coarser(transition)].triangle_count);
}

// As printed, all instances change their level with the frame; else those that begin go where fewer triangles are.
void Director::begin(State& state, const Placement& placement, const Selector& selector) {
    bool is_own = options_.variant == Variant::fsi;
    state.is_odd = is_own && options_.remedies.splits_parities && balance_ > 0;
    balance_ += (state.is_odd ? -1 : 1) * difference(state.transition);
    // Nothing is seen of a change before the new level is drawn.
    if (is_own && drawn_level(state) == state.transition.from) state.transition.phase = 0;
    state.grain_doublings = 0;
    uint32_t change = finer(state.transition);
    if (!is_own || !options_.remedies.suits_grain || change >= grain_m_.size() || grain_m_[change] <= 0) return;
    double doublings = std::ceil(std::log2(selector.pixel_m(placement) / (grain_m_[change] * placement.scale)));
    state.grain_doublings = uint8_t(std::clamp(doublings, 0.0, double(kMostGrainDoublings)));
}

// Returns whether a change of level begins, turns or is done at once.
bool Director::advance(State& state, const Placement& placement, const Selector& selector, double dt_s, bool is_in_view) {
    Transition before = state.transition;
    if (!state.is_known) {
        uint32_t level = selector.wanted(placement);
        state = {{level, level, 0}, true, false, 0};
        return false;
    }
    uint32_t wanted = selector.wanted(placement, before.to);
    if (!fades(options_.variant) || !is_in_view) {
        state.transition = {wanted, wanted, 0};
        return wanted != before.to;
    }
    state.transition = step(before, wanted, dt_s, options_.fade_s, options_.is_one_by_one);
    const Transition& after = state.transition;
    if (before.is_resting() && !after.is_resting()) begin(state, placement, selector);
    bool has_turned = !before.is_resting() && after.to == before.from;
    return (before.is_resting() && after.to != before.to) || has_turned;
}

uint32_t Director::drawn_level(const State& state) const {
    bool is_finer = (frame_count_ % 2 == 1) == state.is_odd;
    return is_finer ? finer(state.transition) : coarser(state.transition);
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
    for (const Item& item : frame_.items) frame_.triangle_count += facts_.levels[item.level].triangle_count;
    for (const Item& item : frame_.translucent) frame_.triangle_count += facts_.levels[item.level].triangle_count;
}

int64_t Director::balance() const {
    int64_t balance = 0;
    for (const State& state : states_) {
        if (!state.transition.is_resting()) balance += (state.is_odd ? -1 : 1) * difference(state.transition);
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
    frame_ = {};
    ++frame_count_;
    balance_ = balance;
    for (uint32_t instance = 0; instance < states_.size(); ++instance) {
        State& state = states_[instance];
        bool is_in_view = selector.is_in_view(placements_[instance]);
        bool has_begun = advance(state, placements_[instance], selector, dt_s, is_in_view);
        if (!is_in_view) continue;
        frame_.begun_count += has_begun;
        ++frame_.in_view_count;
        list(instance, state, selector);
    }
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
