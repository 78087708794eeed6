// "Figures to reach" of frame-sequential interpolation: the form as printed, and Overlook's.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/fsi/flown.h"
#include "tools/measure/paper/target.h"

namespace overlook::measure::paper::fsi {

std::vector<std::string> target_columns();  // "fsi:paper", "fsi"
std::vector<Target> targets_of(const Flown& flown);

}  // namespace overlook::measure::paper::fsi
