// make-sample slopes: three ridges whose sides have known slopes, for what is shown of steep ground.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/scene.h"

namespace overlook::sample {

constexpr uint32_t kSlopesSide = 257;                        // samples
constexpr double kSlopesCell_m = 10;                         // from north to south run the ridges
constexpr std::array<double, 3> kSlopes_deg = {40, 60, 75};  // of both sides of a ridge, from west to east

// Height at a place, metres east and south of the first sample: plains at 0, the ridges, and waves on their sides that keep a
// coarse surface from being right.
double slope_height_m(double east_m, double south_m);

// Towards the ridges from the south, rising nowhere, turning a little west: case S11 of the stability suite.
scene::Flight slopes_flight();

// Writes `dem.tif` and `scene.json` (of `slopes.ovl`, to be baked beside it) into a folder, which it makes where there is none.
// Returns their paths. Fails with Exit::cannot_write.
Result<std::vector<std::string>> make_slopes(const std::string& folder);

}  // namespace overlook::sample
