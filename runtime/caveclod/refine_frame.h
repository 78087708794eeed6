// What one call of Refinement::refine works with.
#pragma once

#include "runtime/caveclod/refine.h"

namespace overlook::caveclod {

struct Refinement::Frame {
    const ScreenTest& test;
    const Settings& settings;
    FrameReport report;
    bool keeps_reserve = false;  // near the budget of triangles: what could be collapsed is wanted by error
    uint64_t operations_left = 0;
};

}  // namespace overlook::caveclod
