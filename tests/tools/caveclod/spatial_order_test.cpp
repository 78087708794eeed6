#include "tools/bake/caveclod/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/tools/caveclod/test_meshes.h"

namespace overlook::caveclod {
namespace {

TEST(SpatialOrder, HasEveryIndexOnceAndEqualPlacesByIndex) {
    mesh::Mesh mesh = test::sphere(20, 10);
    mesh.positions_m.insert(mesh.positions_m.end(), mesh.positions_m.begin(), mesh.positions_m.begin() + 50);
    std::vector<uint32_t> order = order_along_curve(mesh.positions_m), sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (uint32_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], i);
    for (size_t i = 1; i < order.size(); ++i)
        EXPECT_TRUE(mesh.positions_m[order[i - 1]] != mesh.positions_m[order[i]] || order[i - 1] < order[i]);
}

TEST(SpatialOrder, GoesThroughAGridQuadrantByQuadrant) {
    std::vector<glm::vec3> grid;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) grid.emplace_back(x, y, 0);
    EXPECT_EQ(order_along_curve(grid), (std::vector<uint32_t>{0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15}));
}

TEST(SpatialOrder, TakesOnePlaceAndNone) {
    EXPECT_TRUE(order_along_curve({}).empty());
    std::vector<glm::vec3> same(3, glm::vec3(7, 8, 9));
    EXPECT_EQ(order_along_curve(same), (std::vector<uint32_t>{0, 1, 2}));
}

TEST(SpatialOrder, OrdersFacesByTheirFirstCorner) {
    std::vector<mesh::Corners> faces{{3, 4, 5}, {0, 5, 2}, {1, 2, 3}, {5, 4, 0}};
    std::vector<uint32_t> rank{0, 1, 2, 3, 4, 5};
    EXPECT_EQ(order_by_least_corner(faces, rank), (std::vector<uint32_t>{1, 3, 2, 0}));
}

}  // namespace
}  // namespace overlook::caveclod
