// Flies, films, times and draws all that the page holds.
#pragma once

#include <vector>

#include "runtime/command/command.h"
#include "tools/measure/paper/fsi/flown.h"
#include "tools/measure/paper/fsi/subject.h"

namespace overlook::measure::paper::fsi {

// subjects: at least one, uploaded. frames: of figure 8, at least 2. flies_many: 100,000 things, even in software. Fails as
// run_course.
Result<Flown> fly_all(std::vector<Subject>& subjects, uint32_t frames, bool flies_many, const gl::Renderer& renderer,
                      const command::Common& common);

}  // namespace overlook::measure::paper::fsi
