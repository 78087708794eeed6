// "Figures to reach" of tiling layered depth images: with the paper's constants, and as Overlook bakes by itself.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/target.h"
#include "tools/measure/paper/wang_ldi/flown.h"

namespace overlook::measure::paper::wang {

std::vector<std::string> target_columns();  // "the paper's constants", "Overlook"
// Of each plants in turn. What the paper prints is of sunflowers and grass; others have "-".
std::vector<Target> targets_of(const Flown& flown);

}  // namespace overlook::measure::paper::wang
