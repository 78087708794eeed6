// What putting two frames together costs, beside a full-screen copy of the same buffers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/measure/paper/fsi/film.h"

namespace overlook::measure::paper::fsi {

struct Combining {
    std::string scene, method;
    uint32_t side_px = 0;
    // Medians: of the pass while nothing changes and while all of the arc does; of a pass that reads both buffers, colour, ids
    // and depth, at its own pixel and writes colour and depth; of a copy of the buffers' memory (glCopyImageSubData).
    double rest_ms = 0, changing_ms = 0, pass_ms = 0, copy_ms = 0;
    // Of the pixels while all of the arc changes, exact: of squares in which something may be under way, and those for which two
    // frames are put together.
    double changing_share = 0, searched_share = 0;
};

// fsi:paper and fsi over the arc of a film, one sample a pixel. Fails with Exit::impossible (targets).
Result<std::vector<Combining>> time_combining(const World& scene, const Stand& stand, const std::string& name, uint32_t side_px);

// combining.csv: a row each.
std::string combining_csv(const std::vector<Combining>& all);

}  // namespace overlook::measure::paper::fsi
