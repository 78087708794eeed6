// The numbers of one frame (tools/measure/numbers/), put where a run keeps them.
#pragma once

#include <functional>

#include "tools/measure/numbers/silhouette.h"
#include "tools/measure/numbers/temporal.h"
#include "tools/measure/run.h"

namespace overlook::measure {

constexpr double kMostShownW = 0.02;  // luma; what the map of W shows as its brightest: a tile that pops, drawn well, has less

// What a method promised of a frame, in pixels, for the rule of holes: what it predicted, and no more than it was asked for
// unless a budget of triangles kept it from that. 0 for one that is not asked for pixels.
double promised_px(const MethodSpec& spec, const Counters& counters);

// The reference with so many more pixels on every side.
using Surroundings = std::function<Result<Frame>(uint32_t margin_px)>;

// What is taken of every frame: S, holes, PSNR, luma. rule: without its surroundings, which `around` gives: asked only where a
// hole so near the outline is found that what stands outside the picture may be its reason; fails as it does.
Result<void> judge_picture(const Frame& test, const Frame& reference, const HoleRule& rule, const Surroundings& around,
                           Numbers& numbers);

// E, and the frame itself if it is the worst so far by the 99th percentile over its pixels.
void judge_e(const Frame& test, const Frame& reference, FrameRecord& record, WorstFrame& worst);

// W, and the frame itself if it is the worst so far by the mean over its pixels.
TemporalError judge_w(const Motion& motion, const Frame& before, const Frame& now, const Frame& reference_before,
                      const Frame& reference_now, FrameRecord& record, WorstFrame& worst);

}  // namespace overlook::measure
