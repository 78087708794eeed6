// make-sample dem: an elevation model and how it was made.
#pragma once

#include <string>
#include <vector>

#include "formats/result.h"
#include "tools/make_sample/landscape.h"

namespace overlook::sample {

constexpr int kNodata = -9999;

struct DemOptions {
    LandscapeOptions landscape;
    uint32_t void_count = 0;  // holes dug into it, 0..10000
};

struct DemReport {
    std::vector<std::string> files;  // written, in order
    double lowest_m = 0, highest_m = 0;
    uint64_t void_samples = 0;
};

// Writes `dem.tif` (32-bit floats, multiples of kHeightStepM, on UTM zone 32N) `recipe.toml`, `scene.json` (of `sample.ovl`, to
// be baked beside it) and `flight.json` into a folder, which it makes where there is none. Fails with Exit::cannot_write, or with
// Exit::bad_command:
// "--size 20 is outside 33..4097", "--cell-size-m 0 is outside 1..1000", "--voids 20000 is outside 0..10000".
Result<DemReport> make_dem(const DemOptions& options, const std::string& folder);

// Digs `count` irregular holes, each at most a sixteenth of the side wide, at places that follow from the
// seed: samples become `nodata`. samples: [side, side]. Returns how many samples are void.
uint64_t dig_voids(std::vector<float>& samples, uint32_t side, uint32_t count, uint64_t seed, float nodata);

}  // namespace overlook::sample
