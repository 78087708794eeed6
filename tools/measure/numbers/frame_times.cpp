#include "tools/measure/numbers/frame_times.h"

#include <algorithm>

namespace overlook::measure {

MissedDeadlines missed_deadlines(std::span<const double> frame_ms, double deadline_ms) {
    MissedDeadlines missed;
    size_t run = 0;
    for (double ms : frame_ms) {
        run = ms > deadline_ms ? run + 1 : 0;
        missed.count += run > 0;
        missed.longest_run = std::max(missed.longest_run, run);
    }
    return missed;
}

FrameTimes frame_times_of(std::span<const double> frame_ms) {
    return {percentiles_of(frame_ms), missed_deadlines(frame_ms, kDeadline60Ms), missed_deadlines(frame_ms, kDeadline30Ms)};
}

}  // namespace overlook::measure
