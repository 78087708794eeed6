// Baking: the split errors, which are most of it, and the whole.

#include "tests/bench/benchmarks.h"
#include "tests/bench/inputs.h"
#include "tests/bench/work.h"
#include "tools/bake/terrain.h"
#include "tools/bake/terrain_errors.h"

namespace overlook::bench {
namespace {

// Every sample is looked at by two triangles' worth of planes in each of two diamond kinds a level: 4 bytes read once for each;
// 5.4 bytes of errors written.
double error_bytes(const terrain::Shape& shape) {
    return 2.0 * shape.root_log2 * 4 + 5.4;
}

void measure_errors(benchmark::State& state, const Landscape& land) {
    double samples = double(land.terrain.heights.size());
    repeat(state, [&] {
        benchmark::DoNotOptimize(terrain::measure_split_errors(land.terrain.shape, land.terrain.heights));
        return Work{samples, "samples", samples * error_bytes(land.terrain.shape)};
    });
}

void bake_terrain(benchmark::State& state, const Landscape& land) {
    double samples = double(land.dem.samples.size());
    repeat(state, [&] {
        benchmark::DoNotOptimize(terrain::bake(land.dem, {}, [](double) {}));
        return Work{samples, "samples", samples * (4 + error_bytes(land.terrain.shape) + 1.4)};
    });
}

}  // namespace

void add_bake(const std::string& name) {
    add("measure_errors", name, with(name, measure_errors));
    add("bake_terrain", name, with(name, bake_terrain));
}

}  // namespace overlook::bench
