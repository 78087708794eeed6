#include "tools/bake/terrain.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "formats/parallel.h"
#include "formats/terrain_blocks.h"
#include "tools/bake/error_codes.h"
#include "tools/bake/terrain_errors.h"

namespace overlook::terrain {
namespace {

constexpr double kFinestStep_m = 1.0 / 1024;
constexpr size_t kSamplesAtATime = 1 << 16;

double source_height_m(const dem::Raster& dem, size_t i) {
    return dem.height_offset_m + dem.height_scale_m * double(dem.samples[i]);
}

// Over all valid samples, the greatest of what `value` says of each.
template <class Value>
double greatest_over_samples(const dem::Raster& dem, const Value& value) {
    double greatest = 0;
    std::mutex guard;
    parallel_ranges(dem.samples.size(), kSamplesAtATime, [&](size_t begin, size_t end) {
        double here = 0;
        for (size_t i = begin; i < end; ++i)
            if (!std::isnan(dem.samples[i])) here = std::max(here, value(i));
        std::lock_guard lock(guard);
        greatest = std::max(greatest, here);
    });
    return greatest;
}

struct Steps {
    double step_m, offset_m;
};

Result<Steps> choose_steps(const dem::Raster& dem, double asked_m) {
    if (asked_m == 0 && dem.samples_are_integers) return Steps{dem.height_scale_m, dem.height_offset_m};
    double highest = greatest_over_samples(dem, [&](size_t i) { return std::abs(source_height_m(dem, i)); });
    double least_m = highest / kHeightMax;
    if (asked_m == 0) {
        double step_m = kFinestStep_m;
        while (step_m < least_m) step_m *= 2;
        return Steps{step_m, 0};
    }
    if (asked_m < least_m)
        return impossible("heights up to {:.6g} m do not fit steps of {:.6g} m; at least {:.2g} m is needed", highest, asked_m,
                          least_m);
    return Steps{asked_m, 0};
}

void store_heights(const dem::Raster& dem, Terrain& terrain) {
    terrain.heights.resize(dem.samples.size());
    parallel_ranges(dem.samples.size(), kSamplesAtATime, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            bool is_void = std::isnan(dem.samples[i]);
            terrain.heights[i] =
                is_void ? kVoid
                        : int32_t(std::lround((source_height_m(dem, i) - terrain.height_offset_m) / terrain.height_step_m));
        }
    });
}

}  // namespace

Result<Terrain> bake(const dem::Raster& dem, const BakeOptions& options, const std::function<void(double)>& progress) {
    Terrain terrain;
    terrain.shape = shape_of(dem.width, dem.height);
    terrain.frame = dem.frame;
    auto steps = choose_steps(dem, options.height_step_m);
    if (!steps) return tl::unexpected(steps.error());
    terrain.height_step_m = steps->step_m, terrain.height_offset_m = steps->offset_m;

    store_heights(dem, terrain);
    terrain.finest_error_m = greatest_over_samples(dem, [&](size_t i) {
        return std::abs(terrain.height_offset_m + terrain.height_step_m * terrain.heights[i] - source_height_m(dem, i));
    });
    progress(0.1);

    std::vector<std::vector<float>> errors = measure_split_errors(terrain.shape, terrain.heights);
    progress(0.8);
    ErrorCodes coded = encode_errors(errors, terrain.height_step_m, terrain.finest_error_m);
    terrain.error_m = coded.error_m;
    terrain.codes = std::move(coded.codes);
    progress(1);
    return terrain;
}

}  // namespace overlook::terrain
