// Baking a mesh, with bounds and seams, in memory: triangles a millisecond on one thread and on two.

#include <fmt/format.h>

#include "formats/parallel.h"
#include "tests/bench/benchmarks.h"
#include "tests/bench/work.h"
#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/bake.h"

namespace overlook::bench {
namespace {

// Three corners and half a position are read of each triangle; 36 bits of it are stored.
constexpr double kBytes = 3 * sizeof(uint32_t) + 0.5 * sizeof(glm::vec3) + 36.0 / 8;

void bake_mesh(benchmark::State& state, uint32_t side, unsigned threads) {
    mesh::Mesh mesh = caveclod::test::grid(side, side, caveclod::test::rough_m);
    unsigned threads_before = thread_count();
    set_thread_count(threads);
    repeat(state, [&] {
        caveclod::BakeReport report;
        auto baked = caveclod::bake(mesh, {}, report, [](double) {});
        if (!baked) state.SkipWithError(baked.error().message.c_str());
        double triangles = double(mesh.faces.size());
        return Work{triangles, "triangles", triangles * kBytes};
    });
    set_thread_count(threads_before);
}

}  // namespace

void add_bake_mesh(uint32_t side) {
    std::string name = fmt::format("mesh_{}", 2 * side * side);
    add("bake_mesh_1_thread", name, [=](benchmark::State& state) { bake_mesh(state, side, 1); });
    add("bake_mesh_2_threads", name, [=](benchmark::State& state) { bake_mesh(state, side, 2); });
}

}  // namespace overlook::bench
