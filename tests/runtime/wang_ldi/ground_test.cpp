// What is said of the ground in a rectangle is so, and a sheared tile stands as far from it as is said.
#include "runtime/wang_ldi/ground.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/runtime/wang_ldi/field_ground.h"

namespace overlook::wang_ldi {
namespace {

const terrain::Terrain& rough_hills() {
    static const terrain::Terrain terrain = terrain_of(
        121, 90, 10, 12, [](uint32_t column, uint32_t row) { return hill_m(column, row) + (column * 7 + row * 5) % 4; });
    return terrain;
}
Rect random_rect(const Ground& ground, std::mt19937& random, double least_m, double most_m) {
    std::uniform_real_distribution<double> unit(0, 1);
    const Rect& all = ground.extent();
    double side = least_m + (most_m - least_m) * unit(random) * unit(random);
    glm::dvec2 low = all.low_m + (all.high_m - all.low_m - side) * glm::dvec2(unit(random), unit(random));
    return {low, low + side};
}
template <class Visit>
void visit_places(const Rect& rect, int side, const Visit& visit) {
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i) {
            glm::dvec2 share(double(i) / side, double(j) / side);
            visit(share, rect.low_m + (rect.high_m - rect.low_m) * share);
        }
}

TEST(Ground, HasTheHeightsOfItsSamplesAndBetweenThemOfTheirTriangles) {
    Ground ground(rough_hills());
    for (uint32_t row = 0; row < 90; ++row)
        for (uint32_t column = 0; column < 121; ++column)
            EXPECT_DOUBLE_EQ(ground.height_m({column * 10.0, row * -12.0}), rough_hills().height_m(column, row));
    // Middles of cells lie on the diagonal, which joins samples whose column + row is even.
    EXPECT_NEAR(ground.height_m({45, -42}), (rough_hills().height_m(4, 4) + rough_hills().height_m(5, 3)) / 2, 1e-9);
    EXPECT_NEAR(ground.height_m({45, -54}), (rough_hills().height_m(4, 4) + rough_hills().height_m(5, 5)) / 2, 1e-9);
    // Thirds of a triangle.
    double corner = rough_hills().height_m(5, 4), top = rough_hills().height_m(4, 4), right = rough_hills().height_m(5, 5);
    EXPECT_NEAR(ground.height_m({40 + 20.0 / 3, -48 - 4.0}), (corner + top + right) / 3, 1e-9);
}

TEST(Ground, RangeIsTheLeastThatHoldsEveryPlace) {
    Ground ground(rough_hills());
    std::mt19937 random(3);
    for (int i = 0; i < 400; ++i) {
        Rect rect = random_rect(ground, random, 0.5, 200);
        GroundRange range = ground.range(rect), bound = ground.bound(rect);
        ASSERT_TRUE(range.is_whole && bound.is_whole);
        double low = INFINITY, high = -INFINITY, rise = 0;
        visit_places(rect, 40, [&](auto, const glm::dvec2& at) {
            double height = ground.height_m(at);
            low = std::min(low, height), high = std::max(high, height);
            glm::dvec2 step(0.001, 0.001);
            if (!rect.contains({at - step, at + step})) return;
            double x = ground.height_m(at + glm::dvec2(0.001, 0)) - height,
                   y = ground.height_m(at + glm::dvec2(0, 0.001)) - height;
            // Both differences lie in one triangle unless an edge runs between; then each is of a triangle that is touched too.
            rise = std::max({rise, std::abs(x) / 0.001, std::abs(y) / 0.001});
        });
        double grid_m = (rect.high_m.x - rect.low_m.x) / 40, slack = grid_m * range.steepest + 1e-9;
        EXPECT_GE(low, range.low_m);
        EXPECT_LE(low, range.low_m + slack);
        EXPECT_LE(high, range.high_m);
        EXPECT_GE(high, range.high_m - slack);
        EXPECT_LE(rise, range.steepest * (1 + 1e-5));
        EXPECT_LE(bound.low_m, range.low_m);
        EXPECT_GE(bound.high_m, range.high_m);
        EXPECT_GE(bound.steepest, range.steepest);
    }
}

TEST(Ground, LowestOfAWayIsTheLeastOfItsPlaces) {
    Ground ground(rough_hills());
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0, 1);
    Ground::Asked asked;
    for (int i = 0; i < 400; ++i) {
        auto anywhere = [&] { return glm::dvec2(1200 * unit(random), -1068 * unit(random)); };
        glm::dvec2 p = anywhere(), way = (anywhere() - p) * (i % 2 ? 0.02 : 1.0);
        double lowest = INFINITY, last = NAN, steepest = 0;
        for (int n = 0; n <= 4000; ++n) {
            double height = ground.height_m(p + way * (n / 4000.0));
            lowest = std::min(lowest, height);
            if (n > 0) steepest = std::max(steepest, std::abs(height - last));
            last = height;
        }
        double found = ground.lowest_m(p, p + way, asked);
        EXPECT_LE(found, lowest + 1e-9);
        EXPECT_GE(found, lowest - 2 * steepest - 1e-9);
    }
    terrain::Terrain torn =
        terrain_of(21, 21, 10, 10, [](uint32_t column, uint32_t row) { return column == 10 && row == 10 ? double(NAN) : 200.0; });
    Ground with_void(torn);
    Ground::Asked of_void;
    EXPECT_TRUE(std::isnan(with_void.lowest_m({10, -98}, {190, -97}, of_void)));
    EXPECT_TRUE(std::isnan(with_void.lowest_m({190, -97}, {10, -98}, of_void)));
    EXPECT_EQ(with_void.lowest_m({10, -58}, {190, -57}, of_void), 200);
}

TEST(Ground, OfASlantingPlaneTheSteepestIsItsRise) {
    terrain::Terrain plane =
        terrain_of(30, 30, 10, 20, [](uint32_t column, uint32_t row) { return 200 + 3.0 * column - 8.0 * row; });
    Ground ground(plane);
    EXPECT_NEAR(ground.range({{31, -157}, {94, -59}}).steepest, 0.5, 1e-6);
    Sheared sheared = ground.sheared({{31, -157}, {94, -59}});
    EXPECT_NEAR(sheared.displacement_m, 0, 1e-9);
    for (const Plane& half : sheared.halves) {
        EXPECT_NEAR(half.slope.x, 0.3, 1e-9);
        EXPECT_NEAR(half.slope.y, 0.4, 1e-9);
        EXPECT_NEAR(half.height_m, 200 + 0.3 * 31 - 0.4 * 157, 1e-9);
    }
}

TEST(Ground, DisplacementIsTheGreatestDistanceOfGroundAndHalves) {
    Ground ground(rough_hills());
    std::mt19937 random(4);
    double greatest = 0;
    for (int i = 0; i < 300; ++i) {
        Rect rect = random_rect(ground, random, 1, 150);
        for (Diagonal diagonal : {Diagonal::rising, Diagonal::falling}) {
            Sheared sheared = ground.sheared(rect, diagonal);
            double seen = 0;
            visit_places(rect, 60, [&](const glm::dvec2& share, const glm::dvec2& at) {
                const Plane& half = sheared.halves[half_of(diagonal, share.x, share.y)];
                seen = std::max(seen, std::abs(half.height_m + glm::dot(half.slope, at - rect.low_m) - ground.height_m(at)));
            });
            EXPECT_LE(seen, sheared.displacement_m + 1e-9);
            double slack = (rect.high_m.x - rect.low_m.x) / 60 * 2 * ground.range(rect).steepest + 1e-9;
            EXPECT_GE(seen, sheared.displacement_m - slack);
            EXPECT_LE(ground.sheared(rect).displacement_m, sheared.displacement_m);
        }
        greatest = std::max(greatest, ground.sheared(rect).displacement_m);
    }
    EXPECT_GT(greatest, 3.0);
}

TEST(Ground, HalvesMeetAtTheDiagonalAndNeighboursAtTheirSides) {
    Ground ground(rough_hills());
    for (Diagonal diagonal : {Diagonal::rising, Diagonal::falling}) {
        Rect rect{{333, -444}, {347, -430}}, east{{347, -444}, {361, -430}};
        Sheared here = ground.sheared(rect, diagonal), there = ground.sheared(east);
        auto height = [](const Sheared& sheared, const Rect& of, uint32_t half, const glm::dvec2& at) {
            return sheared.halves[half].height_m + glm::dot(sheared.halves[half].slope, at - of.low_m);
        };
        for (double share = 0; share <= 1; share += 0.125) {
            glm::dvec2 at = rect.low_m + 14.0 * glm::dvec2(share, diagonal == Diagonal::rising ? share : 1 - share);
            EXPECT_NEAR(height(here, rect, 0, at), height(here, rect, 1, at), 1e-9);
            glm::dvec2 side(347, -444 + 14 * share);
            EXPECT_NEAR(height(here, rect, 1, side), height(there, east, half_of(there.diagonal, 0, share), side), 1e-9);
        }
        EXPECT_NEAR(height(here, rect, 1, rect.high_m), ground.height_m(rect.high_m), 1e-9);
    }
}

// The farther half of a ray that crosses the diagonal is where its far end is.
TEST(Ground, TheHalfTheEyeIsNotOverIsDrawnFirst) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    int crossed = 0;
    for (int i = 0; i < 20000; ++i) {
        Diagonal diagonal = i % 2 ? Diagonal::rising : Diagonal::falling;
        glm::dvec2 eye(6 * unit(random) - 3, 6 * unit(random) - 3), far(unit(random), unit(random));
        glm::dvec2 near = far + (eye - far) * unit(random);
        if (near.x < 0 || near.x > 1 || near.y < 0 || near.y > 1) continue;
        uint32_t far_half = half_of(diagonal, far.x, far.y);
        if (far_half == half_of(diagonal, near.x, near.y)) continue;
        EXPECT_EQ(farther_half(diagonal, eye.x, eye.y), far_half);
        ++crossed;
    }
    EXPECT_GT(crossed, 1000);
}

TEST(Ground, IsNotThereOutsideAndRoundVoids) {
    terrain::Terrain terrain = terrain_of(
        40, 40, 10, 10, [](uint32_t column, uint32_t row) { return column == 20 && row == 10 ? NAN : hill_m(column, row); });
    Ground ground(terrain);
    EXPECT_FALSE(ground.range({{-1, -50}, {4, -45}}).is_whole);
    EXPECT_TRUE(ground.bound({{-9, -50}, {-1, -45}}).is_empty());
    EXPECT_FALSE(ground.bound({{-9, -50}, {1, -45}}).is_empty());
    EXPECT_FALSE(ground.range({{195, -95}, {196, -94}}).is_whole);
    EXPECT_FALSE(ground.bound({{100, -200}, {300, -50}}).is_whole);
    EXPECT_TRUE(std::isnan(ground.height_m({195.5, -95})));
    EXPECT_TRUE(ground.range({{180, -95}, {190, -94}}).is_whole);
    EXPECT_TRUE(ground.range({{0, -390}, {190, -111}}).is_whole);
    EXPECT_FALSE(std::isnan(ground.height_m({390, -390})));
}

TEST(Ground, APlainIsFlatAndWide) {
    Ground ground = Ground::plain(7);
    Rect rect{{123456, -654321}, {123458, -654319}};
    EXPECT_EQ(ground.height_m(rect.low_m), 7);
    EXPECT_EQ(ground.range(rect).high_m, 7);
    EXPECT_EQ(ground.sheared(rect).displacement_m, 0);
    EXPECT_TRUE(ground.bound({{-1e6, -1e6}, {1e6, 1e6}}).is_whole);
}

}  // namespace
}  // namespace overlook::wang_ldi
