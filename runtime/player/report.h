// What the frames of a run were and cost, as JSON.
#pragma once

#include <string>
#include <vector>

#include "runtime/gl/context.h"
#include "runtime/player/options.h"
#include "runtime/player/scene.h"

namespace overlook::player {

// Everything of the run: renderer, size, every frame, and of each figure the median, the 95th and 99th percentile and the
// maximum.
std::string report_json(const Plan& plan, const gl::Renderer& renderer, const std::vector<FrameRecord>& frames);

// The nearest-rank percentile, share 0..1, of values in any order; 0 if there are none.
double percentile(std::vector<double> values, double share);

// One line for a person: "131,072 triangles, refined in 2.1 ms and drawn in 30 ms by llvmpipe (software), ...".
std::string summary_line(const Plan& plan, const gl::Renderer& renderer, const std::vector<FrameRecord>& frames);

// Writes --report and, with --json, prints; says the summary otherwise. Fails with Exit::cannot_write.
Result<void> deliver_report(const Plan& plan, const command::Common& common, const gl::Renderer& renderer,
                            const std::vector<FrameRecord>& frames);

}  // namespace overlook::player
