// "Figures to reach": what the paper reached, what is asked of Overlook, and what a run measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/measure/paper/figures_8_to_14.h"

namespace overlook::measure::paper {

// One line of the table for every sprite of the cast, in their order.
struct Target {
    std::string name;     // "speed-up of the mean frame"
    std::string printed;  // the paper's, or "-"
    double goal = 0;
    bool is_at_least = true;                      // goal: at least, or at most
    std::vector<std::optional<double>> measured;  // empty: this run cannot tell
    std::string note;
    std::string
        why;  // the cast's last sprite, Overlook's own form, misses it: from the numbers of the run; empty where it does not
    bool is_reached(size_t sprite) const {
        return measured[sprite] && (is_at_least ? *measured[sprite] >= goal : *measured[sprite] <= goal);
    }
};
// The cast has at least one sprite.
std::vector<Target> targets_of(const Flown& flown);

// What a frame costs whatever draws it: indices submitted and a fifth of the pixels drawn, those of keyframes too.
double counted_cost(const Counters& counters, double picture_px);

}  // namespace overlook::measure::paper
