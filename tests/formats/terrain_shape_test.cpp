// The laws of the hierarchy: which squares, diamonds and triangles there are, and that blocks hold each sample and each code
// once.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>

#include "formats/terrain_blocks.h"
#include "formats/terrain_diamond.h"
#include "tests/formats/synthetic_terrain.h"

namespace overlook::terrain {

static bool operator==(GridPoint a, GridPoint b) {
    return a.x == b.x && a.y == b.y;
}

namespace {

constexpr std::array<std::array<uint32_t, 2>, 14> kSizes{
    {{2, 2}, {2, 3}, {3, 2}, {3, 3}, {4, 4}, {5, 4}, {4, 5}, {5, 5}, {6, 3}, {3, 12}, {9, 9}, {10, 17}, {33, 18}, {20, 41}}};

// Calls visit(x, y, level) for every split vertex of the whole virtual grid, also beyond the raster.
template <class Visit>
void visit_split_vertices(const Shape& shape, const Visit& visit) {
    for (uint32_t y = 0; y <= shape.cells_y(); ++y)
        for (uint32_t x = 0; x <= shape.cells_x(); ++x) {
            uint32_t level = uint32_t(std::countr_zero(x | y));
            if (level < shape.root_log2) visit(x, y, level);
        }
}

TEST(TerrainShape, CoversTheRasterWithTheLeastRootsThatSpanItsShorterSide) {
    for (uint32_t width = 2; width < 70; ++width)
        for (uint32_t height = 2; height < 70; ++height) {
            Shape shape = shape_of(width, height);
            uint32_t side = 1u << shape.root_log2, shorter = std::min(width, height) - 1;
            ASSERT_GE(side, shorter);
            ASSERT_LT(side / 2, shorter);
            ASSERT_EQ(std::min(shape.root_columns, shape.root_rows), 1u);
            ASSERT_GE(shape.cells_x(), width - 1);
            ASSERT_GE(shape.cells_y(), height - 1);
            ASSERT_LT(shape.cells_x() - side, width - 1);
            ASSERT_LT(shape.cells_y() - side, height - 1);
        }
}

TEST(TerrainShape, HoldsForTheLongestRasters) {
    Shape shape = shape_of(2, 1u << 30);
    EXPECT_EQ(shape.root_log2, 0u);
    EXPECT_EQ(shape.root_columns, 1u);
    EXPECT_EQ(shape.root_rows, (1u << 30) - 1);
    EXPECT_EQ(block_count_of(shape), (1u << 30) - 1);
    shape = shape_of(3, 715827882);
    EXPECT_EQ(shape.root_log2, 1u);
    EXPECT_EQ(shape.cells_y(), 715827882u);
    LevelGrid grid = level_grid(shape, 0);
    EXPECT_EQ(grid.columns, 3u);
    EXPECT_EQ(grid.rows, 715827883u);
    shape = shape_of(46340, 46340);
    EXPECT_EQ(shape.root_log2, 16u);
    EXPECT_EQ(shape.cells_x(), 65536u);
    EXPECT_EQ(level_grid(shape, 15).columns, 3u);
}

TEST(TerrainDiamonds, HaveTheirSplitVertexInTheMiddleOfALongSideOfRightTriangles) {
    for (auto [width, height] : kSizes) {
        Shape shape = shape_of(width, height);
        visit_split_vertices(shape, [&](uint32_t x, uint32_t y, uint32_t level) {
            Triangle triangles[2];
            int count = triangles_of_diamond(shape, x, y, level, triangles);
            ASSERT_GE(count, 1);
            for (int i = 0; i < count; ++i) {
                const Triangle& t = triangles[i];
                ASSERT_EQ(t.left.x + t.right.x, 2 * x);
                ASSERT_EQ(t.left.y + t.right.y, 2 * y);
                int64_t ax = int64_t(t.left.x) - t.apex.x, ay = int64_t(t.left.y) - t.apex.y;
                int64_t bx = int64_t(t.right.x) - t.apex.x, by = int64_t(t.right.y) - t.apex.y;
                ASSERT_EQ(ax * bx + ay * by, 0) << "no right angle";
                ASSERT_EQ(ax * ax + ay * ay, bx * bx + by * by) << "not isosceles";
                ASSERT_LT(ax * by - ay * bx, 0) << "clockwise, seen with north up";
            }
            if (count == 2) {
                ASSERT_TRUE(triangles[0].left == triangles[1].right && triangles[0].right == triangles[1].left);
            }
        });
    }
}

// The split vertex of the diamond that a half of a triangle belongs to: the middle of that half's long side.
TEST(TerrainDiamonds, SplitIntoTrianglesOfDiamondsThatFollow) {
    for (auto [width, height] : kSizes) {
        Shape shape = shape_of(width, height);
        visit_split_vertices(shape, [&](uint32_t x, uint32_t y, uint32_t level) {
            Triangle triangles[2];
            int count = triangles_of_diamond(shape, x, y, level, triangles);
            bool is_square = diamond_kind(x, y, level) == DiamondKind::square;
            if (!is_square && level == 0) return;  // its halves are the finest triangles
            for (int i = 0; i < count; ++i) {
                for (Triangle half : {Triangle{{x, y}, triangles[i].apex, triangles[i].left},
                                      Triangle{{x, y}, triangles[i].right, triangles[i].apex}}) {
                    uint32_t child_x = (half.left.x + half.right.x) / 2, child_y = (half.left.y + half.right.y) / 2;
                    uint32_t child_level = is_square ? level : level - 1;
                    ASSERT_EQ(uint32_t(std::countr_zero(child_x | child_y)), child_level);
                    Triangle of_child[2];
                    int child_count = triangles_of_diamond(shape, child_x, child_y, child_level, of_child);
                    bool is_there = std::any_of(of_child, of_child + child_count, [&](const Triangle& t) {
                        return t.apex == half.apex && t.left == half.left && t.right == half.right;
                    });
                    ASSERT_TRUE(is_there) << x << ", " << y << " of " << shape.width << " x " << shape.height;
                    if (is_degenerate(shape, triangles[i])) {
                        ASSERT_TRUE(is_degenerate(shape, half));
                    }
                }
            }
        });
    }
}

TEST(TerrainDiamonds, StandInTheGridOfTheirLevelUnlessTheyAreSqueezedToNothing) {
    for (auto [width, height] : kSizes) {
        Shape shape = shape_of(width, height);
        visit_split_vertices(shape, [&](uint32_t x, uint32_t y, uint32_t level) {
            Triangle triangles[2];
            int count = triangles_of_diamond(shape, x, y, level, triangles);
            bool is_drawn =
                std::any_of(triangles, triangles + count, [&](const Triangle& t) { return !is_degenerate(shape, t); });
            LevelGrid grid = level_grid(shape, level);
            ASSERT_EQ(grid.columns % 2, 1u);
            ASSERT_EQ(grid.rows % 2, 1u);
            ASSERT_TRUE(!is_drawn || ((x >> level) < grid.columns && (y >> level) < grid.rows)) << x << ", " << y;
        });
    }
}

Terrain all_void(uint32_t width, uint32_t height) {
    return synthetic_terrain(width, height, [](uint32_t, uint32_t) { return true; });
}

void expect_in_one_block(Terrain& terrain, uint32_t x, uint32_t y) {
    int32_t& height = terrain.heights[size_t(y) * terrain.shape.width + x];
    height = 5;
    size_t holders = 0;
    for (const Block& block : blocks_of(terrain.shape)) {
        BlockRange range = range_of(terrain, block);
        holders += range.low == 5 && range.high == 5;
        ASSERT_TRUE(range.low == 5 || range.low > range.high);
    }
    ASSERT_EQ(holders, 1u) << x << ", " << y << " of " << terrain.shape.width << " x " << terrain.shape.height;
    height = kVoid;
}

TEST(TerrainBlocks, HoldEverySampleOnce) {
    for (auto [width, height] : kSizes) {
        Terrain terrain = all_void(width, height);
        for (uint32_t y = 0; y < height; ++y)
            for (uint32_t x = 0; x < width; ++x) expect_in_one_block(terrain, x, y);
    }
    Terrain terrain = all_void(259, 300);
    for (uint32_t y : {0u, 1u, 2u, 127u, 128u, 129u, 255u, 256u, 257u, 298u, 299u})
        for (uint32_t x : {0u, 1u, 2u, 127u, 128u, 129u, 254u, 255u, 256u, 257u, 258u}) expect_in_one_block(terrain, x, y);
}

// Flat ground takes one byte a sample and one a code, and four for each block's head.
TEST(TerrainBlocks, HoldNothingTwice) {
    std::vector<std::array<uint32_t, 2>> sizes(kSizes.begin(), kSizes.end());
    for (std::array<uint32_t, 2> size : {std::array{129u, 129u}, {130u, 257u}, {259u, 300u}, {2u, 77u}, {90u, 2u}})
        sizes.push_back(size);
    for (auto [width, height] : sizes) {
        Terrain terrain = synthetic_terrain(width, height, no_void);
        std::fill(terrain.heights.begin(), terrain.heights.end(), 0);
        std::vector<Block> blocks = blocks_of(terrain.shape);
        EXPECT_EQ(blocks.size(), block_count_of(terrain.shape));
        uint64_t bytes = 0, expected = 4 * blocks.size() + terrain.heights.size();
        for (const Block& block : blocks) {
            bytes += pack_block(terrain, block).size();
            EXPECT_LE(pack_block(terrain, block).size(), packed_bytes_max(terrain.shape, block));
        }
        for (uint32_t level = 0; level < terrain.shape.root_log2; ++level) {
            LevelGrid grid = level_grid(terrain.shape, level);
            expected += uint64_t(grid.columns) * grid.rows - uint64_t((grid.columns + 1) / 2) * ((grid.rows + 1) / 2);
        }
        EXPECT_EQ(bytes, expected) << width << " x " << height;
    }
}

TEST(TerrainBlocks, ComeCoarseToFineWithAllRootsFirst) {
    std::vector<Block> blocks = blocks_of(shape_of(1000, 300));
    EXPECT_TRUE(std::is_sorted(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.level > b.level; }));
    EXPECT_EQ(std::count_if(blocks.begin(), blocks.end(), [](const Block& block) { return block.is_top; }), 2);  // 512 wide each
    EXPECT_EQ(blocks.front().level, 2u);
    EXPECT_EQ(blocks.back().level, 0u);
}

}  // namespace
}  // namespace overlook::terrain
