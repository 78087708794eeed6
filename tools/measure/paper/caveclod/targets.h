// "Figures to reach" of CAVECLOD that section 4 can show: the form as printed, and Overlook's.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/caveclod/flown.h"
#include "tools/measure/paper/target.h"

namespace overlook::measure::paper::cameras {

std::vector<std::string> target_columns();  // "caveclod:paper", "caveclod"
std::vector<Target> targets_of(const Flown& flown);

}  // namespace overlook::measure::paper::cameras
