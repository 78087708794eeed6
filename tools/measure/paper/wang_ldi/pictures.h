// The pictures of the paper's figures, and what is counted in them.
#pragma once

#include <functional>

#include "tools/measure/paper/wang_ldi/flown.h"

namespace overlook::measure::paper::wang {

constexpr uint32_t kWidth_px = 640, kHeight_px = 480;  // of figure 2's pictures

// Figures 2 to 9, 11 and 12, and all that is told of the subject. Fails as what it reads.
Result<Plants> plants_of(const Subject& subject, const std::function<void(double)>& done);

}  // namespace overlook::measure::paper::wang
