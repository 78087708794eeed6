#include "runtime/lod_sprite/paper_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/runtime/lod_sprite/paper_fixture.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::lod_sprite::paper {
namespace {

// 20 m wide round the origin, flat but for the vertex in the middle.
QuadrantShape bump(double height_m) {
    return {{{-10, 10, 0}, {10, 10, 0}, {10, -10, 0}, {-10, -10, 0}}, {0, 0, height_m}, true};
}

// One corner 8 m up: no three of its corners and their mean lie on one plane.
QuadrantShape tent(bool is_main_diagonal) {
    return {{{-10, 10, 0}, {10, 10, 8}, {10, -10, 0}, {-10, -10, 0}}, {0, 0, 5}, is_main_diagonal};
}

TEST(PaperParallax, IsThatOfTheRayBeyondABump) {
    // From 100 m away and 50 m above the bump's 2 m the ray comes down 4 m behind it.
    glm::dvec3 key_eye(-100, 0, 52), above(0, 0, 40);
    for (Plane plane : {Plane::fan, Plane::drawn})
        EXPECT_NEAR(parallax_rad(bump(2), key_eye, above, plane), std::atan(4.0 / 40), 1e-12);
    // Seen from where the ray goes, the two are in line the other way round: the angle is that of a triangle at C'.
    EXPECT_NEAR(parallax_rad(bump(2), key_eye, {4, 0, 40}, Plane::fan), std::atan(4.0 / 38), 1e-12);
}

TEST(PaperParallax, IsThatOfTheRayBeforeAPit) {
    // The ray to the pit's bottom, 50 m below the eye, meets the ground 2 m above it: 4 m before it.
    glm::dvec3 key_eye(-100, 0, 48), above(0, 0, 40);
    for (Plane plane : {Plane::fan, Plane::drawn})
        EXPECT_NEAR(parallax_rad(bump(-2), key_eye, above, plane), std::atan(4.0 / 40), 1e-12);
}

TEST(PaperParallax, IsZeroFromTheKeysOwnPlace) {
    for (double height_m : {-3.0, 2.0, 90.0})
        for (glm::dvec3 eye : {glm::dvec3(-100, 7, 52), glm::dvec3(3, 200, 1), glm::dvec3(0, 0, 500)})
            EXPECT_NEAR(parallax_rad(bump(height_m), eye, eye, Plane::fan), 0, 1e-12);
}

TEST(PaperParallax, IsZeroEverywhereIfCIsTheMeanOfTheCorners) {
    // What the text says to the letter.
    QuadrantShape literal = tent(true);
    literal.centre.z = 2;
    for (glm::dvec3 eye : {glm::dvec3(-100, 7, 52), glm::dvec3(30, 200, 11), glm::dvec3(0, 0, 500)})
        EXPECT_NEAR(parallax_rad(literal, {-100, 0, 55}, eye, Plane::fan), 0, 1e-12);
    EXPECT_GT(parallax_rad(literal, {-100, 0, 55}, {0, 0, 500}, Plane::drawn), 0.001);
}

TEST(PaperParallax, TakesTheCornersOfTheSideThatTheRayLeavesThrough) {
    // The ray falls 0.5 m a metre eastwards from C, 5 m up. The mean of the corners is 2 m up; east of it the fan is z = 2 + 0.2
    // x.
    glm::dvec3 key_eye(-100, 0, 55), above(0, 0, 105);
    double x = 3 / 0.7;
    EXPECT_NEAR(parallax_rad(tent(true), key_eye, above, Plane::fan), std::atan(x / (100 + 0.5 * x)), 1e-12);
    // Northwards it is z = 2 + 0.2 y.
    EXPECT_NEAR(parallax_rad(tent(true), {0, -100, 55}, above, Plane::fan), std::atan(x / (100 + 0.5 * x)), 1e-12);
    // Westwards the fan is flat between two corners at 0: z = 2 + 0.2 x again, now falling away.
    x = 3 / 0.3;
    EXPECT_NEAR(parallax_rad(tent(true), {100, 0, 55}, above, Plane::fan), std::atan(x / (100 + 0.5 * x)), 1e-12);
}

TEST(PaperParallax, TakesTheDrawnTriangleIfAskedTo) {
    glm::dvec3 key_eye(-100, 0, 55), above(0, 0, 105);
    // Cut from north-west to south-east, the north-eastern half is z = 0.4 (x + y).
    double x = 5 / 0.9;
    EXPECT_NEAR(parallax_rad(tent(true), key_eye, above, Plane::drawn), std::atan(x / (100 + 0.5 * x)), 1e-12);
    // Cut the other way, the south-eastern half is z = 4 + 0.4 y.
    EXPECT_NEAR(parallax_rad(tent(false), key_eye, above, Plane::drawn), std::atan(2.0 / 101), 1e-12);
}

TEST(PaperParallax, TakesARayThatMissesTheGroundToBeInfinite) {
    // Past the bump the ray rises by 1 m in 100; seen from the south the bump is due north.
    EXPECT_NEAR(parallax_rad(bump(2), {-100, 0, 1}, {0, -50, 2}, Plane::fan), std::numbers::pi / 2, 1e-12);
}

TEST(PaperParallax, HoldsAnglesThatTheDotProductLoses) {
    // A step to the side of 1e-7 m.
    double angle = parallax_rad(bump(2), {-100, 0, 52}, {-100, 1e-7, 52}, Plane::fan);
    double c = std::hypot(100.0, 50.0), beyond = c * 104 / 100;  // to C and C'
    EXPECT_NEAR(angle, 1e-7 * (1 / c - 1 / beyond), 1e-14);
}

TEST(PaperError, IsTheRootOfTheMeanSquareInPixels) {
    // Four squares of two cells, one with a bump of 2 m in its middle at column 1, row 1; C' as in the tests above.
    terrain::Terrain terrain = test::plain_terrain(5);
    terrain.heights[1 * 5 + 1] = 2;
    view::Camera key = test::square_camera({10 - 100, -10, 52}, 90, -20), now = test::square_camera({10, -10, 40}, 0, -90);
    double angle_px = std::atan(4.0 / 40) * 180 / std::numbers::pi / 0.15;
    ErrorFigures figures = ErrorMetric(terrain).measure(key, now, test::squares_cut(5, 2));
    EXPECT_EQ(figures.quadrant_count, 4u);
    EXPECT_EQ(figures.with_centre_count, 4u);
    EXPECT_NEAR(figures.rms_px, angle_px / 2, 1e-9);
    EXPECT_NEAR(figures.p99_px, angle_px, 1e-9);
    EXPECT_NEAR(figures.max_px, angle_px, 1e-9);
}

TEST(PaperError, HidesASpireThatTheMaximumShows) {
    terrain::Terrain terrain = test::plain_terrain(41);  // 400 squares of two cells
    terrain.heights[21 * 41 + 21] = 100;
    view::Camera key = test::square_camera({0, -400, 500}, 45, -60), now = test::square_camera({60, -340, 500}, 45, -60);
    ErrorFigures figures = ErrorMetric(terrain).measure(key, now, test::squares_cut(41, 2));
    EXPECT_GT(figures.quadrant_count, 200u);
    EXPECT_EQ(figures.p99_px, 0);
    EXPECT_GT(figures.max_px, 1);
    EXPECT_NEAR(figures.rms_px, figures.max_px / std::sqrt(double(figures.quadrant_count)), 1e-9);
}

TEST(PaperError, CountsSingleCellsAsRight) {
    terrain::Terrain terrain = test::plain_terrain(5);
    view::Camera key = test::square_camera({-90, -10, 52}, 90, -20), now = test::square_camera({20, -20, 60}, 0, -90);
    ErrorFigures figures = ErrorMetric(terrain).measure(key, now, test::squares_cut(5, 1));
    EXPECT_EQ(figures.quadrant_count, 16u);
    EXPECT_EQ(figures.with_centre_count, 0u);
    EXPECT_EQ(figures.max_px, 0);
}

TEST(PaperError, LooksAtNothingOutOfView) {
    terrain::Terrain terrain = test::plain_terrain(5);
    terrain::Cut cut = test::squares_cut(5, 2);
    ErrorMetric metric(terrain);
    view::Camera key = test::square_camera({-90, -10, 52}, 90, -20);
    // From 4 m above the middle of the north-western square one sees 4 m round it: no other square, nor this one's corners, but
    // its middle.
    EXPECT_EQ(metric.measure(key, test::square_camera({10, -10, 4}, 0, -90), cut).quadrant_count, 1u);
    EXPECT_EQ(metric.measure(key, test::square_camera({10, -10, 4}, 0, 90), cut).quadrant_count, 0u);
    EXPECT_EQ(metric.measure(key, test::square_camera({20, 100, 4}, 0, 0), cut).quadrant_count, 0u);
    EXPECT_EQ(metric.measure(key, test::square_camera({20, 100, 4}, 180, 0), cut).quadrant_count, 4u);
    EXPECT_EQ(metric.measure(key, key, {}).quadrant_count, 0u);
}

TEST(PaperError, DescendsAStatedNumberOfLevels) {
    terrain::Terrain terrain = test::plain_terrain(9);
    view::Camera now = test::square_camera({40, -40, 200}, 0, -90);
    for (int levels = 0; levels <= 5; ++levels) {
        ErrorMetric metric(terrain, {Plane::fan, levels});
        size_t across = size_t(1) << std::min(levels, 3);
        EXPECT_EQ(metric.measure(now, now, {}).quadrant_count, across * across) << levels;
    }
}

// How often each cell of the raster is covered by quadrants.
std::vector<int> coverage(const terrain::Terrain& terrain, const std::vector<Quadrant>& quadrants) {
    std::vector<int> covered(terrain.heights.size());
    for (const Quadrant& q : quadrants)
        for (uint32_t row = q.row0; row < q.row1; ++row)
            for (uint32_t column = q.column0; column < q.column1; ++column) ++covered[row * terrain.shape.width + column];
    return covered;
}

void expect_each_cell_once(const terrain::Terrain& terrain, const std::vector<Quadrant>& quadrants) {
    std::vector<int> covered = coverage(terrain, quadrants);
    size_t wrong = 0;
    for (uint32_t row = 0; row + 1 < terrain.shape.height; ++row)
        for (uint32_t column = 0; column + 1 < terrain.shape.width; ++column)
            wrong += covered[row * terrain.shape.width + column] != 1;
    EXPECT_EQ(wrong, 0u);
}

terrain::Terrain baked(const dem::Raster& dem) {
    auto terrain = terrain::bake(dem, {}, [](double) {});
    EXPECT_TRUE(terrain.has_value());
    return std::move(*terrain);
}

struct Size {
    uint32_t width, height;
};

TEST(PaperQuadrants, CoverTheGroundOnceForAnySizeOfRaster) {
    for (Size size : {Size{129, 129}, {128, 128}, {100, 77}, {67, 200}, {33, 131}, {2, 2}, {3, 90}}) {
        terrain::Terrain terrain = baked(overlook::test::make_hills(size.width, size.height, 3));
        terrain::Refiner refiner(terrain);
        terrain::Cut cut;
        Quadrants quadrants;
        for (double tolerance_m : {-1.0, 2.0, 20.0, 200.0, 1e9}) {
            refiner.cut_by_metres(tolerance_m, cut);
            SCOPED_TRACE(testing::Message() << size.width << " x " << size.height << " at " << tolerance_m << " m");
            expect_each_cell_once(terrain, quadrants.of_cut(terrain, cut));
        }
        for (uint32_t levels = 0; levels <= terrain.shape.root_log2; ++levels)
            expect_each_cell_once(terrain, quadrants.of_level(terrain, levels));
    }
}

TEST(PaperQuadrants, DrawTheirCornersOnTheDiagonalAndNotTheirMiddle) {
    terrain::Terrain terrain = baked(overlook::test::make_hills(129, 129, 3));
    terrain::Refiner refiner(terrain);
    terrain::Cut cut;
    refiner.cut_by_metres(15, cut);
    std::set<uint32_t> drawn(cut.indices.begin(), cut.indices.end());
    Quadrants quadrants;
    size_t with_centre = 0;
    for (const Quadrant& q : quadrants.of_cut(terrain, cut)) {
        EXPECT_EQ(q.column1 - q.column0, q.row1 - q.row0);
        uint32_t west = q.is_main_diagonal ? q.row0 : q.row1, east = q.is_main_diagonal ? q.row1 : q.row0;
        EXPECT_TRUE(drawn.count(west * 129 + q.column0) && drawn.count(east * 129 + q.column1));
        if (!q.has_centre()) continue;
        ++with_centre;
        EXPECT_FALSE(drawn.count(q.centre_row() * 129 + q.centre_column()));
    }
    EXPECT_GT(with_centre, 100u);
}

TEST(PaperQuadrants, LeaveVoidsOut) {
    dem::Raster dem = overlook::test::make_hills(65, 65, 3, 0.02);
    ASSERT_GT(dem.void_count, 20u);
    terrain::Terrain terrain = baked(dem);
    terrain::Refiner refiner(terrain);
    terrain::Cut cut;
    refiner.cut_by_metres(30, cut);
    Quadrants quadrants;
    size_t with_centre = 0;
    for (const Quadrant& q : quadrants.of_cut(terrain, cut)) {
        if (!q.has_centre()) continue;
        ++with_centre;
        for (uint32_t row = q.row0; row <= q.row1; ++row)
            for (uint32_t column = q.column0; column <= q.column1; ++column) EXPECT_FALSE(terrain.is_void(column, row));
    }
    EXPECT_GT(with_centre, 10u);
    view::Camera now = test::square_camera({1000, -1300, 4000}, 0, -90), key = now;
    key.position_m.x -= 500;
    for (int levels : {kCutLevels, 0, 2, 4, 6}) {
        ErrorFigures figures = ErrorMetric(terrain, {Plane::fan, levels}).measure(key, now, cut);
        EXPECT_LT(figures.max_px, 60) << levels;
    }
}

}  // namespace
}  // namespace overlook::lod_sprite::paper
