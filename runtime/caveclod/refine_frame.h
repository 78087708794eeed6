// What one call of Refinement::refine works with.
#pragma once

#include <atomic>

#include "runtime/caveclod/refine.h"
#include "runtime/caveclod/screen_test.h"

namespace overlook::caveclod {

struct Refinement::Frame {
    Frame(const Mesh& mesh, const view::Camera& seen_by, const Settings& asked, const view::FinerParts* finer)
        : test(mesh, seen_by, asked, finer),
          camera(seen_by),
          settings(asked),
          operations_left(asked.most_operations > 0 ? asked.most_operations : ~uint64_t(0)) {}

    ScreenTest test;
    const view::Camera& camera;
    const Settings& settings;
    FrameReport report;
    uint32_t greatest_left = 0;  // whose error is report.error_px, where a split's is
    bool keeps_reserve = false;  // near the budget of triangles: what could be collapsed is wanted by error
    bool asks_applied = true;    // false: it is known that all that is applied stays
    uint64_t operations_left = 0;
    // As much is known to be left unsplit in view: nothing less need be looked at closely. Parts tell each other; what they find
    // together does not depend on who was first.
    mutable std::atomic<double> known_px{0};
};

}  // namespace overlook::caveclod
