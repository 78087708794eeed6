// What is measured on: made or read, and baked, when the first benchmark wants it.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/terrain.h"
#include "runtime/terrain/refine.h"
#include "tools/bake/dem.h"

namespace overlook::bench {

struct Landscape {
    dem::Raster dem;
    terrain::Terrain terrain;
};

// Hills like a generated sample of their size, 1025 and 4097 samples a side, and the real elevation models where OVERLOOK_DATA
// says that they are; small: hills of 129 alone, to try the benchmarks themselves.
std::vector<std::string> landscape_names(bool small);

// By a name from above; the last one asked for is kept.
Result<const Landscape*> landscape(const std::string& name);

// A benchmark's body on a landscape; one that cannot be had is the benchmark's failure.
std::function<void(benchmark::State&)> with(const std::string& name,
                                            std::function<void(benchmark::State&, const Landscape&)> body);

// From above the middle of a landscape, looking outwards.
view::Camera overview(const terrain::Terrain& terrain, double highest_m, double turn_deg);

}  // namespace overlook::bench
