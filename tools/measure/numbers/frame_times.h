// Frame times as a viewer feels them: percentiles and missed deadlines, never a mean.
#pragma once

#include <cstddef>
#include <span>

#include "tools/measure/numbers/percentiles.h"

namespace overlook::measure {

constexpr double kDeadline60Ms = 16.7, kDeadline30Ms = 33.3;

struct MissedDeadlines {
    size_t count = 0;        // frames longer than the deadline
    size_t longest_run = 0;  // of such frames one after the other
};

struct FrameTimes {
    Percentiles ms;
    MissedDeadlines missed_60, missed_30;
};

// frame_ms: of each frame, in order of time.
FrameTimes frame_times_of(std::span<const double> frame_ms);
MissedDeadlines missed_deadlines(std::span<const double> frame_ms, double deadline_ms);

}  // namespace overlook::measure
