// A terrain tile by tile is the terrain.
#include "formats/terrain_tiles.h"

#include <gtest/gtest.h>

#include <cstring>

#include "formats/terrain_diamond.h"
#include "formats/terrain_extents.h"
#include "tests/formats/scratch_folder.h"
#include "tests/formats/synthetic_terrain.h"

namespace overlook::terrain {
namespace {

std::string written(const ScratchFolder& folder, const Terrain& terrain) {
    Result<container::Writer> writer = container::Writer::create(folder / "a.ovl", kKind);
    EXPECT_TRUE(writer && write(*writer, terrain) && write_tiles(*writer, terrain) && writer->commit());
    return folder / "a.ovl";
}

// All tiles, each decoded from those it needs.
std::vector<std::vector<std::byte>> decoded_tiles(const TileFile& file) {
    std::vector<std::vector<std::byte>> tiles;
    for (uint32_t tile = 0; tile < file.grid().count(); ++tile) {
        std::vector<std::span<const std::byte>> needed;
        for (uint32_t need : file.grid().needs_of(tile)) needed.push_back(tiles[need]);
        auto decoded = file.decode(tile, needed);
        EXPECT_TRUE(decoded) << decoded.error().message;
        EXPECT_EQ(decoded->size(), file.grid().bytes(tile));
        tiles.push_back(std::move(*decoded));
    }
    return tiles;
}

template <class T>
T value_at(const std::vector<std::byte>& tile, size_t at) {
    T value;
    std::memcpy(&value, tile.data() + at, sizeof(T));
    return value;
}

void expect_tiles_hold(const Terrain& terrain, const TileFile& file) {
    const Shape& shape = terrain.shape;
    const TileGrid& grid = file.grid();
    SquareRanges ranges(terrain);
    std::vector<std::vector<std::byte>> tiles = decoded_tiles(file);
    for (uint32_t level = 0; level < shape.root_log2; ++level) {
        LevelGrid vertices = level_grid(shape, level);
        uint32_t stage = std::min(level, grid.top());
        for (uint32_t j = 0; j < vertices.rows; ++j)
            for (uint32_t i = 0; i < vertices.columns; ++i) {
                if (((i | j) & 1) == 0) continue;
                uint32_t x = i << level, y = j << level, tile = grid.at(stage, x, y), local = grid.local(tile, x, y);
                GridPoint sample = sample_of(shape, {x, y});
                ASSERT_EQ(value_at<int32_t>(tiles[tile], 4 * size_t(local)),
                          terrain.heights[size_t(sample.y) * shape.width + sample.x])
                    << x << ' ' << y << " level " << level;
                ASSERT_EQ(value_at<uint8_t>(tiles[tile], grid.codes_at(tile) + local),
                          terrain.codes[level][size_t(j) * vertices.columns + i]);
                if ((i & j & 1) == 0) continue;
                StepRange range = ranges.of_square(x, y, level);
                auto told =
                    value_at<StepRange>(tiles[tile], TileGrid::kRangesAt + 8 * size_t(grid.local_square(tile, x, y, level)));
                ASSERT_EQ(told.is_empty(), range.is_empty());
                if (range.is_empty()) continue;
                ASSERT_TRUE(told.low == range.low && told.high == range.high);
            }
    }
    uint32_t side = 1u << shape.root_log2;
    for (uint32_t y = 0; y <= shape.root_rows; ++y)
        for (uint32_t x = 0; x <= shape.root_columns; ++x) {
            uint32_t tile = grid.at(grid.top(), x * side, y * side);
            GridPoint sample = sample_of(shape, {x * side, y * side});
            ASSERT_EQ(value_at<int32_t>(tiles[tile], 4 * size_t(grid.local(tile, x * side, y * side))),
                      terrain.heights[size_t(sample.y) * shape.width + sample.x]);
        }
}

TEST(TerrainTiles, HoldTheTerrainOfAnyShapeWithAnyVoids) {
    const VoidTest voids[] = {no_void, [](uint32_t x, uint32_t y) { return x % 7 == 1 && y % 5 < 3; },
                              [](uint32_t x, uint32_t) { return x > 40; }};
    const uint32_t sizes[][2] = {{2, 2},     {3, 3},     {3, 9},     {65, 65},   {129, 129},
                                 {130, 130}, {257, 140}, {300, 260}, {513, 513}, {137, 700}};
    for (const auto& size : sizes)
        for (VoidTest is_void : voids) {
            SCOPED_TRACE(fmt::format("{} x {}", size[0], size[1]));
            ScratchFolder folder;
            Terrain terrain = synthetic_terrain(size[0], size[1], is_void);
            Result<container::Reader> reader = container::Reader::open(written(folder, terrain));
            ASSERT_TRUE(reader);
            Result<Terrain> whole = read(*reader);
            ASSERT_TRUE(whole) << whole.error().message;
            EXPECT_TRUE(whole->heights == terrain.heights);
            Result<TileFile> file = TileFile::open(*reader);
            ASSERT_TRUE(file) << file.error().message;
            expect_tiles_hold(terrain, *file);
        }
}

TEST(TerrainTiles, SayWhatIsWrongWhereThereAreNone) {
    ScratchFolder folder;
    Result<container::Writer> writer = container::Writer::create(folder / "a.ovl", kKind);
    ASSERT_TRUE(writer && write(*writer, synthetic_terrain(9, 9, no_void)) && writer->commit());
    Result<container::Reader> reader = container::Reader::open(folder / "a.ovl");
    ASSERT_TRUE(reader);
    Result<TileFile> file = TileFile::open(*reader);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().exit, Exit::bad_input);
    EXPECT_EQ(file.error().message, folder / "a.ovl" + ": holds no tiles to stream; bake it again with --streamed");
}

}  // namespace
}  // namespace overlook::terrain
