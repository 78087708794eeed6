// "Figures to reach" of LOD-sprite, one column of each sprite of the cast.
#pragma once

#include <vector>

#include "tools/measure/paper/lod_sprite/figures_8_to_14.h"
#include "tools/measure/paper/target.h"

namespace overlook::measure::paper::sprite {

// The cast has at least one sprite; the last is Overlook's own form, whose misses are explained.
std::vector<Target> targets_of(const Flown& flown);

// What a frame costs whatever draws it: indices submitted and a fifth of the pixels drawn, those of keyframes too.
double counted_cost(const Counters& counters, double picture_px);

}  // namespace overlook::measure::paper::sprite
