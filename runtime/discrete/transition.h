// How one level gives way to another in time: pure functions.
//
// Based on: M. Giegl, M. Wimmer, Unpopping, 2007, and D. Scherzer, M. Wimmer, Frame Sequential Interpolation for Discrete
// Level-of-Detail Rendering, 2008, 3.1 (the two ramps). Different here: it runs on time, turns back on its way, and ends.
#pragma once

#include <algorithm>
#include <cstdint>

namespace overlook::discrete {

// Of one instance. At rest from == to and phase is 0.
struct Transition {
    uint32_t from = 0, to = 0;
    double phase = 0;  // 0..1: the new level fades in until 0.5, then the old one out

    bool is_resting() const { return from == to; }
    bool operator==(const Transition&) const = default;
};

// How much of a level is visible, 0..1: one of the two is whole at any time.
double visible_share_of_new(double phase);
double visible_share_of_old(double phase);
// That of one of its two levels.
double visible_share(const Transition& transition, uint32_t level);

// How far a change looks that has come to `phase`: it sets off and comes to rest in an eighth of its time each, so that neither
// its first frame nor its last differs as much from the one beside it as those under way. 0 to 0, 1 to 1, rising; one that turns
// back looks as before it turned: 1 less of 1 - phase.
double eased(double phase);

// Goes on by dt_s >= 0 towards `wanted`. One that rests begins if another level is wanted: to it at once, or to the one beside
// its own if is_one_by_one. One under way turns back if what is wanted is nearer to where it came from: the levels change their
// parts and phase becomes 1 - phase, so that nothing jumps; else it ends where it goes, and only then may begin anew. It is under
// way for fade_s at most from when it begins or turns; it never rests and begins in one call.
Transition step(const Transition& now, uint32_t wanted, double dt_s, double fade_s, bool is_one_by_one);

inline uint32_t finer(const Transition& transition) {
    return std::min(transition.from, transition.to);
}
inline uint32_t coarser(const Transition& transition) {
    return std::max(transition.from, transition.to);
}

}  // namespace overlook::discrete
