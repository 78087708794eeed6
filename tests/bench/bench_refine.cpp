// Refining: cuts in metres and in pixels, from still and from moving cameras, and what they are made of.

#include <fmt/format.h>

#include "runtime/terrain/predict.h"
#include "runtime/terrain/screen_test.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/inputs.h"
#include "tests/bench/work.h"

namespace overlook::bench {
namespace {

constexpr double kMorph = 0.5;  // the player's

// A code and a height range for each vertex tested, three indices for each triangle.
constexpr double kTestBytes = 1 + sizeof(terrain::HeightRange), kTriangleBytes = 3 * sizeof(uint32_t);

void refine_whole(benchmark::State& state, const Landscape& land) {
    terrain::Refiner refiner(land.terrain);
    terrain::Cut cut;
    repeat(state, [&] {
        refiner.cut_by_metres(5, cut);
        double triangles = double(cut.triangle_count());
        return Work{triangles, "triangles", double(cut.tested_count) + kTriangleBytes * triangles};
    });
}

// Four cameras that look different ways: what one sees another does not.
void refine_view(benchmark::State& state, const Landscape& land, double error_px, double morph) {
    terrain::Refiner refiner(land.terrain);
    terrain::Cut cut;
    repeat(state, [&] {
        double triangles = 0, tested = 0, morphs = 0;
        for (double turn_deg : {0.0, 90.0, 180.0, 270.0}) {
            refiner.cut_by_pixels(overview(land.terrain, refiner.highest_m(), turn_deg), error_px, cut, morph);
            triangles += double(cut.triangle_count()), tested += double(cut.tested_count), morphs += double(cut.morphs.size());
        }
        return Work{triangles, "triangles",
                    tested * kTestBytes + triangles * kTriangleBytes + morphs * double(sizeof(terrain::Cut::Morph))};
    });
}

// The same camera frame after frame into a cut that has its memory already: the column `allocations` shows what is left.
void refine_steady(benchmark::State& state, const Landscape& land) {
    terrain::Refiner refiner(land.terrain);
    terrain::Cut cut;
    view::Camera camera = overview(land.terrain, refiner.highest_m(), 45);
    repeat(state, [&] {
        refiner.cut_by_pixels(camera, 1, cut, kMorph);
        double triangles = double(cut.triangle_count()), morphs = double(cut.morphs.size());
        return Work{
            triangles, "triangles",
            double(cut.tested_count) * kTestBytes + triangles * kTriangleBytes + morphs * double(sizeof(terrain::Cut::Morph))};
    });
}

// Every square of every level, in view or not.
void screen_test(benchmark::State& state, const Landscape& land) {
    terrain::HeightBounds bounds(land.terrain);
    const terrain::Shape& shape = land.terrain.shape;
    terrain::ScreenTest test(land.terrain, bounds, overview(land.terrain, bounds.whole().high_m, 45), {1, 0});
    repeat(state, [&] {
        double tests = 0, greatest = 0;
        size_t split_count = 0;
        for (uint32_t level = 0; level < shape.root_log2; ++level) {
            uint32_t s = 1u << level;
            terrain::LevelGrid grid = terrain::level_grid(shape, level);
            for (uint32_t j = 1; j < grid.rows; j += 2) {
                for (uint32_t i = 1; i < grid.columns; i += 2) {
                    uint8_t planes = terrain::ScreenTest::kAllPlanes;
                    uint8_t code = land.terrain.codes[level][size_t(j) * grid.columns + i];
                    split_count += test({i * s, j * s}, level, true, code, planes, greatest).verdict == terrain::Verdict::split;
                }
            }
            tests += double(grid.columns / 2) * (grid.rows / 2);
        }
        benchmark::DoNotOptimize(split_count);
        return Work{tests, "tests", tests * kTestBytes};
    });
}

void height_bounds(benchmark::State& state, const Landscape& land) {
    double samples = double(land.terrain.heights.size());
    repeat(state, [&] {
        benchmark::DoNotOptimize(terrain::HeightBounds(land.terrain));
        return Work{samples, "samples", samples * (4 + 2.7)};
    });
}

void predict_triangles(benchmark::State& state, const Landscape& land) {
    terrain::Refiner refiner(land.terrain);
    terrain::Cut cut;
    cut.wants_codes = true;
    view::Camera camera = overview(land.terrain, refiner.highest_m(), 45);
    refiner.cut_by_pixels(camera, 1, cut, kMorph);
    std::vector<float> predicted_px;
    double triangles = double(cut.triangle_count());
    repeat(state, [&] {
        terrain::predict_triangles(land.terrain, cut, camera, 1, predicted_px);
        // Indices, a code and half a vertex's height in, a prediction out.
        return Work{triangles, "triangles", triangles * (kTriangleBytes + 1 + 2 + sizeof(float))};
    });
}

}  // namespace

void add_refinement(const std::string& name) {
    add("height_bounds", name, with(name, height_bounds));
    add("refine_whole_at_5m", name, with(name, refine_whole));
    for (double error_px : {1.0, 4.0}) {
        for (double morph : {0.0, kMorph}) {
            add(fmt::format("refine_view_at_{:g}px{}", error_px, morph > 0 ? "_morph" : ""), name,
                with(name, [=](benchmark::State& state, const Landscape& land) { refine_view(state, land, error_px, morph); }));
        }
    }
    add("refine_steady", name, with(name, refine_steady));
    add("screen_test", name, with(name, screen_test));
    add("predict_triangles", name, with(name, predict_triangles));
}

}  // namespace overlook::bench
