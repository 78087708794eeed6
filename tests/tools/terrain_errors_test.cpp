#include "tools/bake/terrain_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "formats/parallel.h"
#include "formats/terrain_diamond.h"
#include "tests/tools/synthetic_dem.h"

namespace overlook::terrain {
namespace {

std::vector<int32_t> heights_of(const dem::Raster& dem) {
    std::vector<int32_t> heights;
    for (float sample : dem.samples) heights.push_back(std::isnan(sample) ? kVoid : int32_t(sample));
    return heights;
}

// The definition in its plainest form: every triangle against every sample of the raster, then down through what it splits into.
class BruteForce {
  public:
    BruteForce(const Shape& shape, const std::vector<int32_t>& heights) : shape_(shape), heights_(heights) {}

    double error(uint32_t x, uint32_t y, uint32_t level) {
        auto [at, is_new] = known_.try_emplace({x, y, level}, 0.0);
        if (!is_new) return at->second;
        Triangle triangles[2];
        int count = triangles_of_diamond(shape_, x, y, level, triangles);
        double worst = 0;
        for (int i = 0; i < count; ++i) {
            worst = std::max(worst, own_deviation(triangles[i]));
            worst = std::max(worst, error_below({x, y}, triangles[i].apex, triangles[i].left));
            worst = std::max(worst, error_below({x, y}, triangles[i].right, triangles[i].apex));
        }
        return known_[{x, y, level}] = worst;
    }

  private:
    // Of the diamond in which a child triangle (apex, left, right) is split.
    double error_below(GridPoint apex, GridPoint left, GridPoint right) {
        if (is_degenerate(shape_, {apex, left, right})) return 0;
        uint32_t x2 = left.x + right.x, y2 = left.y + right.y;
        if (x2 % 2 != 0 || y2 % 2 != 0) return 0;  // a finest triangle
        uint32_t x = x2 / 2, y = y2 / 2, level = 0;
        while ((((x | y) >> level) & 1) == 0) ++level;
        return error(x, y, level);
    }

    double own_deviation(const Triangle& t) const {
        if (is_degenerate(shape_, t)) return 0;
        std::array<GridPoint, 3> p{sample_of(shape_, t.apex), sample_of(shape_, t.left), sample_of(shape_, t.right)};
        double area = turn(p[0], p[1], p[2]), worst = 0;
        for (uint32_t y = 0; y < shape_.height; ++y)
            for (uint32_t x = 0; x < shape_.width; ++x) {
                double a = turn(p[1], p[2], {x, y}) / area, b = turn(p[2], p[0], {x, y}) / area,
                       c = turn(p[0], p[1], {x, y}) / area;
                if (a < 0 || b < 0 || c < 0) continue;
                if (at({x, y}) == kVoid) return INFINITY;
                double z = a * at(p[0]) + b * at(p[1]) + c * at(p[2]);
                worst = std::max(worst, std::abs(z - at({x, y})));
            }
        return worst;
    }
    static double turn(GridPoint a, GridPoint b, GridPoint c) {
        return (double(b.x) - a.x) * (double(c.y) - a.y) - (double(b.y) - a.y) * (double(c.x) - a.x);
    }
    int32_t at(GridPoint p) const { return heights_[size_t(p.y) * shape_.width + p.x]; }

    const Shape& shape_;
    const std::vector<int32_t>& heights_;
    std::map<std::array<uint32_t, 3>, double> known_;
};

// Compares every split vertex whose diamond is not squeezed to nothing; returns how many.
int expect_equal_to_brute_force(const dem::Raster& dem) {
    Shape shape = shape_of(dem.width, dem.height);
    std::vector<int32_t> heights = heights_of(dem);
    auto errors = measure_split_errors(shape, heights);
    EXPECT_EQ(errors.size(), shape.root_log2);
    BruteForce truth(shape, heights);
    int compared = 0;
    for (uint32_t level = 0; level < shape.root_log2; ++level) {
        LevelGrid grid = level_grid(shape, level);
        for (uint32_t j = 0; j < grid.rows; ++j)
            for (uint32_t i = 0; i < grid.columns; ++i) {
                if (((i | j) & 1) == 0) continue;
                Triangle triangles[2];
                int count = triangles_of_diamond(shape, i << level, j << level, level, triangles);
                if (std::all_of(triangles, triangles + count, [&](const Triangle& t) { return is_degenerate(shape, t); }))
                    continue;
                double expected = truth.error(i << level, j << level, level),
                       measured = errors[level][size_t(j) * grid.columns + i];
                bool is_equal = measured == expected || std::abs(measured - expected) < 1e-4;
                EXPECT_TRUE(is_equal) << measured << ", truth " << expected << " at " << i << "," << j << " level " << level;
                ++compared;
            }
    }
    return compared;
}

TEST(SplitErrors, EqualThoseOfEveryTriangleAgainstEverySample) {
    for (auto [width, height] : {std::pair{9u, 9u}, {17u, 17u}, {33u, 17u}})
        EXPECT_GT(expect_equal_to_brute_force(test::make_hills(width, height, width)), 50);
}

TEST(SplitErrors, EqualThemWhereTheRasterSqueezesTheGrid) {
    for (auto [width, height] : {std::pair{2u, 2u}, {2u, 9u}, {3u, 5u}, {13u, 7u}, {20u, 11u}, {23u, 23u}, {40u, 6u}})
        expect_equal_to_brute_force(test::make_hills(width, height, height));
}

TEST(SplitErrors, AreInfiniteWhereverAVoidIsCovered) {
    for (auto [width, height] : {std::pair{17u, 17u}, {13u, 22u}, {31u, 9u}})
        expect_equal_to_brute_force(test::make_hills(width, height, 5, 0.15));
}

TEST(SplitErrors, OfAPlaneAreZeroWhereTheGridIsNotSqueezed) {
    dem::Raster plane = test::make_dem(65, 65, [](uint32_t x, uint32_t y) { return float(3 * x + 5 * y); });
    for (const auto& level : measure_split_errors(shape_of(65, 65), heights_of(plane)))
        for (float error : level) EXPECT_EQ(error, 0);
}

TEST(SplitErrors, SeeASpireThatNoMidpointSees) {
    // One sample that is the midpoint of finest edges alone: one-step errors of every coarser diamond are 0 there.
    dem::Raster spire = test::make_dem(65, 65, [](uint32_t x, uint32_t y) { return x == 21 && y == 34 ? 700.0f : 0.0f; });
    Shape shape = shape_of(65, 65);
    auto errors = measure_split_errors(shape, heights_of(spire));
    LevelGrid top = level_grid(shape, shape.root_log2 - 1);
    EXPECT_EQ(errors.back()[size_t(1) * top.columns + 1], 700);
}

TEST(SplitErrors, AreTheSameWithAnyThreadCount) {
    dem::Raster dem = test::make_hills(301, 203, 9, 0.05);
    Shape shape = shape_of(301, 203);
    set_thread_count(1);
    auto one = measure_split_errors(shape, heights_of(dem));
    for (unsigned threads : {2u, 7u}) {
        set_thread_count(threads);
        EXPECT_EQ(measure_split_errors(shape, heights_of(dem)), one);
    }
    set_thread_count(0);
}

}  // namespace
}  // namespace overlook::terrain
