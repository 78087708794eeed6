// Elevation model in, terrain with certified errors out.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "formats/image.h"
#include "formats/terrain.h"
#include "tools/bake/dem.h"

namespace overlook::terrain {

struct BakeOptions {
    // Heights are stored as whole steps. 0 = exactly where the source is whole numbers, else the finest power of two that is at
    // least 1/1024 m and holds the heights. The rounding is measured and counts towards every error.
    double height_step_m = 0;
};

// Bakes in memory. `dem` must have at least one valid sample. Cost O(samples * log samples) time; about 15 bytes a sample at the
// most. `progress` is called with the share done, 0..1, from this thread. Fails with Exit::impossible if the heights do not fit
// 2^28 steps: "heights up to 9000 m do not fit steps of 1e-06 m; at least 3.4e-05 m is needed".
Result<Terrain> bake(const dem::Raster& dem, const BakeOptions& options, const std::function<void(double)>& progress);

}  // namespace overlook::terrain
