// The ground under tiles is the terrain that is drawn where it is drawn to the last triangle.
#include <gtest/gtest.h>

#include "runtime/terrain/refine.h"
#include "runtime/wang_ldi/ground.h"
#include "tests/runtime/hills.h"

namespace overlook::wang_ldi {
namespace {

TEST(GroundOnTerrain, HasTheHeightsOfEveryTriangleOfTheFinestCut) {
    for (auto [width, height] : {std::pair{65u, 33u}, {90u, 47u}, {33u, 70u}}) {
        terrain::Terrain terrain = terrain::baked(test::make_hills(width, height, 4));
        ASSERT_EQ(terrain.finest_error_m, 0);
        terrain::Refiner refiner(terrain);
        terrain::Cut cut;
        refiner.cut_by_metres(0, cut);
        Ground ground(terrain);
        uint64_t inside = 0;
        for (size_t t = 0; t < cut.indices.size(); t += 3) {
            glm::dvec3 a = refiner.vertex_m(cut, cut.indices[t]), b = refiner.vertex_m(cut, cut.indices[t + 1]),
                       c = refiner.vertex_m(cut, cut.indices[t + 2]);
            if (std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) < 1) continue;  // squeezed flat at the rim
            for (int n = 0; n < 10; ++n) {
                double u = test::random_share(5, t, uint64_t(n)), v = (1 - u) * test::random_share(6, t, uint64_t(n));
                glm::dvec3 at = a + u * (b - a) + v * (c - a);
                ASSERT_NEAR(ground.height_m(glm::dvec2(at)), at.z, 1e-9) << t << " of " << width << " x " << height;
                ++inside;
            }
        }
        EXPECT_GT(inside, uint64_t(width - 1) * (height - 1) * 10);
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
