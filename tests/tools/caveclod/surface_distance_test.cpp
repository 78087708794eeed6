// Distances between surfaces whose answer is known.
#include "tools/bake/caveclod/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/tools/caveclod/test_meshes.h"
#include "tools/bake/caveclod/distances.h"

namespace overlook::caveclod {
namespace {

TriangleTree tree_of(const mesh::Mesh& mesh) {
    return TriangleTree(test::triangles_of(mesh.positions_m, mesh.faces));
}

TEST(SurfaceDistance, OfParallelPlanesIsTheirGap) {
    TriangleTree low = tree_of(test::grid(7, 5, [](double, double) { return 0.0; }));
    TriangleTree high = tree_of(test::grid(3, 4, [](double, double) { return 0.25; }));
    Distance distance = two_sided_distance(low, high, 0.01, 1e-9, 100000);
    EXPECT_NEAR(distance.least_m, 0.25, 1e-12);
    EXPECT_NEAR(distance.most_m, 0.25, 0.25 * 0.011);
}

TEST(SurfaceDistance, IsTheGreaterOfBothWays) {
    TriangleTree small(std::vector<Triangle>{{glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}});
    TriangleTree large(std::vector<Triangle>{{glm::dvec3(0, 0, 0), glm::dvec3(3, 0, 0), glm::dvec3(0, 1, 0)}});
    EXPECT_NEAR(one_sided_distance(small, large, 0.01, 1e-9, 10000).least_m, 0, 1e-9);
    EXPECT_NEAR(two_sided_distance(small, large, 0.01, 1e-9, 10000).least_m, 2, 1e-9);
}

TEST(SurfaceDistance, FindsWhatNoCornerShows) {
    // A tent over a plane that has no corner under its ridge: the farthest point of the plane's triangles is inside one of them.
    TriangleTree plane(std::vector<Triangle>{{glm::dvec3(-9, -9, 0), glm::dvec3(9, -9, 0), glm::dvec3(0, 9, 0)}});
    std::vector<Triangle> ring;
    for (int i = 0; i < 6; ++i) {
        auto at = [](int k) { return glm::dvec3(std::cos(k * 1.0471975512), std::sin(k * 1.0471975512), 0) * 4.0; };
        ring.push_back({at(i), at(i + 1), (at(i) + at(i + 1)) * 0.55});
    }
    Distance distance = one_sided_distance(plane, TriangleTree(ring), 0.001, 1e-6, 1000000);
    EXPECT_LE(distance.least_m, distance.most_m);
    EXPECT_LE(distance.most_m, distance.least_m * 1.0011 + 1e-6);
}

TEST(SurfaceDistance, HoldsBothBoundsWhenStoppedEarly) {
    TriangleTree smooth = tree_of(test::sphere(20, 10)), rough = tree_of(test::sphere(40, 20, 0.05));
    Distance exact = two_sided_distance(smooth, rough, 0.001, 1e-7, 1000000);
    for (uint64_t steps : {0u, 1u, 10u, 100u}) {
        Distance early = two_sided_distance(smooth, rough, 0.001, 1e-7, steps);
        EXPECT_LE(early.least_m, exact.most_m);
        EXPECT_GE(early.most_m, exact.least_m);
    }
}

TEST(SurfaceDistance, SaysWhetherItIsEnoughInWhateverOrderTrianglesCome) {
    mesh::Mesh smooth = test::sphere(20, 10), rough = test::sphere(40, 20, 0.05);
    auto of_smooth = test::triangles_of(smooth.positions_m, smooth.faces);
    auto of_rough = test::triangles_of(rough.positions_m, rough.faces);
    double exact_m = two_sided_distance(TriangleTree(of_smooth), TriangleTree(of_rough), 1e-5, 1e-9, 1000000).most_m;
    std::mt19937 random(3);
    int missed_by_gap = 0;
    for (int order = 0; order < 20; ++order) {
        std::shuffle(of_smooth.begin(), of_smooth.end(), random), std::shuffle(of_rough.begin(), of_rough.end(), random);
        TriangleTree a(of_smooth), b(of_rough);
        double enough_m = 1.0001 * exact_m;
        Distance asked = two_sided_distance(a, b, 0.02, 1e-9, 1000000, enough_m);
        EXPECT_LE(asked.most_m, enough_m);
        EXPECT_LE(asked.least_m, asked.most_m);
        missed_by_gap += two_sided_distance(a, b, 0.02, 1e-9, 1000000).most_m > enough_m;
        EXPECT_GT(two_sided_distance(a, b, 0.02, 1e-9, 1000000, 0.999 * exact_m).least_m, 0.999 * exact_m);
    }
    EXPECT_GT(missed_by_gap, 0);  // a bound within a gap may be above it
}

TEST(TriangleTree, FindsTheNearestOfAll) {
    mesh::Mesh mesh = test::sphere(30, 15, 0.1);
    auto triangles = test::triangles_of(mesh.positions_m, mesh.faces);
    TriangleTree tree(triangles);
    std::mt19937 random(1);
    auto share = [&] { return double(random()) / 4294967296.0 * 4 - 2; };
    for (int i = 0; i < 300; ++i) {
        glm::dvec3 p(share(), share(), share());
        double least2 = 1e300;
        for (const Triangle& t : triangles) least2 = std::min(least2, distance2_to_triangle(p, probe_of(t[0], t[1], t[2])));
        EXPECT_NEAR(tree.nearest(p).distance_m, std::sqrt(least2), 1e-12);
    }
}

TEST(TriangleDistance, IsThatOfTheNearestOfManyPoints) {
    std::mt19937 random(2);
    auto share = [&] { return double(random()) / 4294967296.0; };
    auto point = [&] { return glm::dvec3(share(), share(), share()); };
    for (int i = 0; i < 200; ++i) {
        Triangle t{point(), point(), point()};
        glm::dvec3 p = point() * 3.0 - 1.0;
        double distance = std::sqrt(distance2_to_triangle(p, probe_of(t[0], t[1], t[2]))), least = 1e300;
        for (int u = 0; u <= 60; ++u)
            for (int v = 0; u + v <= 60; ++v)
                least = std::min(least, glm::distance(p, t[0] + (t[1] - t[0]) * (u / 60.0) + (t[2] - t[0]) * (v / 60.0)));
        EXPECT_LE(distance, least + 1e-12);
        EXPECT_GE(distance, least - 0.03);
    }
}

}  // namespace
}  // namespace overlook::caveclod
