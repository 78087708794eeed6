// The numbers of one frame (tools/measure/numbers/), put where a run keeps them.
#pragma once

#include "tools/measure/numbers/temporal.h"
#include "tools/measure/run.h"

namespace overlook::measure {

// What is taken of every frame: S, holes, PSNR, luma.
void judge_picture(const Frame& test, const Frame& reference, Numbers& numbers);

// E, and the frame itself if it is the worst so far by the 99th percentile over its pixels.
void judge_e(const Frame& test, const Frame& reference, FrameRecord& record, WorstFrame& worst);

// W, and the frame itself if it is the worst so far by the mean over its pixels.
TemporalError judge_w(const Motion& motion, const Frame& before, const Frame& now, const Frame& reference_before,
                      const Frame& reference_now, FrameRecord& record, WorstFrame& worst);

}  // namespace overlook::measure
