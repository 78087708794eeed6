// Figures 1 to 7 of the paper, drawn by Overlook.
#pragma once

#include <string>
#include <vector>

#include "tools/measure/paper/fsi/flown.h"
#include "tools/measure/paper/fsi/subject.h"

namespace overlook::measure::paper::fsi {

// All that can be drawn of the subjects: figures 1 and 2 of the last whose levels are made by hand (else of the last), 3, 4 and 7
// of the first, 5 of one that moves, 6 of all. Fails with Exit::impossible (targets).
Result<std::vector<Picture>> pictures_of(const std::vector<Subject>& subjects);

}  // namespace overlook::measure::paper::fsi
