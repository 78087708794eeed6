// That the checks of a terrain find each single place where its promise is broken, within the raster and along its edges.
#include "formats/terrain_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/terrain_diamond.h"
#include "tests/formats/synthetic_terrain.h"

namespace overlook::terrain {
namespace {

constexpr std::array<std::array<uint32_t, 2>, 9> kSizes{
    {{3, 3}, {4, 4}, {5, 4}, {4, 9}, {9, 9}, {6, 3}, {17, 12}, {12, 33}, {33, 33}}};

Terrain without_errors(uint32_t width, uint32_t height) {
    Terrain terrain = synthetic_terrain(width, height, no_void);
    for (auto& level : terrain.codes) std::fill(level.begin(), level.end(), uint8_t(0));
    return terrain;
}

// Calls visit(x, y, level, code, triangles that have an area) for every diamond that has a code.
template <class Visit>
void visit_codes(Terrain& terrain, const Visit& visit) {
    for (uint32_t level = 0; level < terrain.shape.root_log2; ++level) {
        LevelGrid grid = level_grid(terrain.shape, level);
        for (uint32_t j = 0; j < grid.rows; ++j)
            for (uint32_t i = 0; i < grid.columns; ++i) {
                if (((i | j) & 1) == 0) continue;
                Triangle both[2];
                int count = triangles_of_diamond(terrain.shape, i << level, j << level, level, both);
                std::vector<Triangle> drawn;
                std::copy_if(both, both + count, std::back_inserter(drawn),
                             [&](const Triangle& t) { return !is_degenerate(terrain.shape, t); });
                visit(i << level, j << level, level, terrain.codes[level][size_t(j) * grid.columns + i], drawn);
            }
    }
}

TEST(TerrainCheck, FindsEveryCodeAboveItsParent) {
    for (auto [width, height] : kSizes) {
        Terrain terrain = without_errors(width, height);
        ASSERT_FALSE(find_code_above_parent(terrain));
        visit_codes(terrain, [&](uint32_t x, uint32_t y, uint32_t level, uint8_t& code, const std::vector<Triangle>& drawn) {
            bool is_root = level + 1 == terrain.shape.root_log2 && diamond_kind(x, y, level) == DiamondKind::square;
            code = 1;
            auto place = find_code_above_parent(terrain);
            code = 0;
            ASSERT_EQ(place.has_value(), !is_root && !drawn.empty())
                << x << ", " << y << " of " << terrain.shape.width << " x " << terrain.shape.height;
            if (place) {
                ASSERT_EQ(std::tuple(place->x, place->y, place->level), std::tuple(x, y, level));
            }
        });
    }
}

TEST(TerrainCheck, FindsEveryDiamondThatCoversAVoidUnmarked) {
    for (auto [width, height] : kSizes) {
        Terrain terrain = without_errors(width, height);
        ASSERT_FALSE(find_unmarked_void(terrain));
        for (size_t sample = 0; sample < terrain.heights.size(); ++sample) {
            int32_t kept = terrain.heights[sample];
            terrain.heights[sample] = kVoid;
            size_t marked = 0;
            visit_codes(terrain, [&](uint32_t x, uint32_t y, uint32_t level, uint8_t& code, const std::vector<Triangle>& drawn) {
                if (level > 0 || diamond_kind(x, y, 0) == DiamondKind::square) return;
                bool covers = std::any_of(drawn.begin(), drawn.end(), [&](const Triangle& t) {
                    return std::ranges::any_of(std::array{t.apex, t.left, t.right, GridPoint{x, y}}, [&](GridPoint p) {
                        GridPoint at = sample_of(terrain.shape, p);
                        return size_t(at.y) * terrain.shape.width + at.x == sample;
                    });
                });
                if (!covers) return;
                auto place = find_unmarked_void(terrain);  // those before are marked: it must be this one
                ASSERT_TRUE(place);
                ASSERT_EQ(std::pair(place->x, place->y), std::pair(x, y));
                code = kMustSplit, ++marked;
            });
            ASSERT_GE(marked, 1u);
            ASSERT_FALSE(find_unmarked_void(terrain));
            terrain.heights[sample] = kept;
            std::fill(terrain.codes[0].begin(), terrain.codes[0].end(), uint8_t(0));
        }
    }
}

TEST(TerrainCheck, RoundsUpToTheNextFloatAndNoFurther) {
    for (double value : {0.0, 0.1, 1.0 / 3, 1.0, 16777217.0, 1e12, 1e-300}) {
        float rounded = float_at_least(value);
        EXPECT_GE(double(rounded), value);
        EXPECT_TRUE(value == 0 || double(std::nextafter(rounded, 0.0f)) < value) << value;
    }
    EXPECT_EQ(float_at_least(0.5), 0.5f);
}

}  // namespace
}  // namespace overlook::terrain
