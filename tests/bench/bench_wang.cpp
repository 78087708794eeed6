// Ground of Wang tiles: tiling it, which is checked tile by tile, a tile by itself, and planting.

#include <fmt/format.h>

#include "tests/bench/benchmarks.h"
#include "tests/bench/work.h"
#include "tools/bake/wang_ldi/plant.h"
#include "tools/bake/wang_ldi/tile_sets.h"

namespace overlook::bench {
namespace {

using namespace wang_ldi;

TileSet default_set() {
    SearchReport report;
    return make_tile_set({}, report).value_or(TileSet{});
}

void tile_rows(benchmark::State& state, uint32_t side) {
    TileSet set = default_set();
    repeat(state, [&] {
        auto tiling = tile_row_by_row(set, side, side, {});
        if (!tiling) state.SkipWithError(tiling.error().message.c_str());
        NeighbourCount count = tiling ? count_neighbours(set, *tiling) : NeighbourCount{1, 0};
        if (count.disagreeing + count.equal > 0) state.SkipWithError("neighbours disagree or are equal");
        return Work{double(side) * side, "tiles", double(side) * side};
    });
}

void tile_at_random(benchmark::State& state, uint32_t count) {
    auto tiling = RandomTiling::of(default_set(), 1);
    repeat(state, [&] {
        uint64_t sum = 0;
        for (uint32_t i = 0; i < count; ++i) sum += tiling->at(int64_t(i) * 7919 % 100003, int64_t(i) * 104729 % 99991);
        benchmark::DoNotOptimize(sum);
        return Work{double(count), "tiles", double(count)};
    });
}

void plant_tiles(benchmark::State& state) {
    TileSet set = default_set();
    PlantOptions options;
    PlantModel model;
    model.tight_radius_m = 0.45f, model.packing_radius_m = 0.5f;
    options.tile_size_m = 5.36, options.models = {model};
    repeat(state, [&] {
        PlantReport report;
        auto planting = plant(set, options, report);
        if (!planting) state.SkipWithError(planting.error().message.c_str());
        double objects = report.density_per_m2 * options.tile_size_m * options.tile_size_m * double(set.tiles.size());
        return Work{objects * options.candidates, "objects", objects * options.candidates * sizeof(Planted)};
    });
}

}  // namespace

void add_wang(uint32_t side) {
    add("tile_row_by_row", fmt::format("tiles_{}", uint64_t(side) * side),
        [=](benchmark::State& state) { tile_rows(state, side); });
    add("tile_at_random", "set_12", [=](benchmark::State& state) { tile_at_random(state, side); });
    add("plant_tiles", "set_12", plant_tiles);
}

}  // namespace overlook::bench
