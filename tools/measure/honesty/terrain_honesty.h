// G, honesty: what a cut of a terrain promises of each triangle, against what it does.
#pragma once

#include <vector>

#include "runtime/terrain/refine.h"
#include "tools/measure/numbers/honesty.h"

namespace overlook::measure {

constexpr double kNotSeen = -1;

// For every triangle of a cut: the greatest distance on the screen, in pixels, between a source sample that it covers (at the
// same column and row; borders count) and the point that it draws there, over the samples of which one or the other is in the
// frame; kNotSeen if there is none, infinite if one of the two is behind the eye. Source samples stand where the file has them,
// or with unsure_m > 0 at most so far above or below, wherever that is worst. Exact point-in-triangle arithmetic. O(samples
// covered).
void measure_triangles(const terrain::Terrain& terrain, const terrain::Cut& cut, const view::Camera& camera,
                       std::vector<float>& measured_px, double unsure_m = 0);

// What a cut made with wants_codes for this camera at error_px promises of the triangles seen, and what they do.
Promises promises_of(const terrain::Terrain& terrain, const terrain::Cut& cut, const view::Camera& camera, double error_px);

}  // namespace overlook::measure
