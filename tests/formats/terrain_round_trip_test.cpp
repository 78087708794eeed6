// What is written comes back, whatever its shape and its holes; and is the same bytes each time.
#include <gtest/gtest.h>

#include <ostream>

#include "formats/parallel.h"
#include "formats/terrain.h"
#include "formats/terrain_check.h"
#include "tests/formats/scratch_folder.h"
#include "tests/formats/synthetic_terrain.h"

namespace overlook::terrain {
namespace {

Result<uint64_t> write_file_of(const Terrain& terrain, const std::string& path) {
    Result<container::Writer> writer = container::Writer::create(path, kKind);
    if (!writer) return tl::unexpected(writer.error());
    if (Result<void> written = write(*writer, terrain); !written) return tl::unexpected(written.error());
    return writer->commit();
}

struct Size {
    uint32_t width, height;
};
void PrintTo(const Size& size, std::ostream* out) {
    *out << size.width << 'x' << size.height;
}

class TerrainOfSize : public testing::TestWithParam<Size> {};

void expect_same(const Terrain& read, const Terrain& written) {
    EXPECT_EQ(read.shape.width, written.shape.width);
    EXPECT_EQ(read.shape.height, written.shape.height);
    EXPECT_EQ(read.frame.metres_per_column, written.frame.metres_per_column);
    EXPECT_EQ(read.frame.metres_per_row, written.frame.metres_per_row);
    EXPECT_EQ(read.frame.is_georeferenced, written.frame.is_georeferenced);
    EXPECT_EQ(read.frame.centre_latitude_deg, written.frame.centre_latitude_deg);
    EXPECT_EQ(read.frame.centre_longitude_deg, written.frame.centre_longitude_deg);
    EXPECT_EQ(read.frame.convergence_deg, written.frame.convergence_deg);
    EXPECT_EQ(read.frame.scale_distortion, written.frame.scale_distortion);
    EXPECT_EQ(read.frame.crs, written.frame.crs);
    EXPECT_EQ(read.height_step_m, written.height_step_m);
    EXPECT_EQ(read.height_offset_m, written.height_offset_m);
    EXPECT_EQ(read.finest_error_m, written.finest_error_m);
    EXPECT_EQ(read.error_m, written.error_m);
    EXPECT_EQ(read.texture.width, written.texture.width);
    EXPECT_EQ(read.texture.height, written.texture.height);
    EXPECT_TRUE(read.texture.pixels == written.texture.pixels);
    EXPECT_TRUE(read.heights == written.heights);
    EXPECT_TRUE(read.codes == written.codes);
}

TEST_P(TerrainOfSize, ComesBackWithAnyVoids) {
    ScratchFolder folder;
    const VoidTest tests[] = {no_void, [](uint32_t x, uint32_t y) { return x == 1 && y == 1; },
                              [](uint32_t x, uint32_t y) { return ((x ^ y) & 1) != 0; },
                              [](uint32_t x, uint32_t y) { return x != 1 || y != 0; }, [](uint32_t, uint32_t) { return true; }};
    for (size_t i = 0; i < std::size(tests); ++i) {
        SCOPED_TRACE(i);
        Terrain terrain = synthetic_terrain(GetParam().width, GetParam().height, tests[i]);
        ASSERT_FALSE(find_code_above_parent(terrain));
        ASSERT_FALSE(find_unmarked_void(terrain));
        Result<uint64_t> written = write_file_of(terrain, folder / "a.ovl");
        ASSERT_TRUE(written) << written.error().message;
        Result<Terrain> back = read(folder / "a.ovl");
        ASSERT_TRUE(back) << back.error().message;
        expect_same(*back, terrain);
    }
}

INSTANTIATE_TEST_SUITE_P(Each, TerrainOfSize,
                         testing::Values(Size{2, 2}, Size{2, 3}, Size{3, 2}, Size{3, 3}, Size{5, 4}, Size{4, 9}, Size{6, 3},
                                         Size{129, 129}, Size{130, 257}, Size{300, 131}, Size{2, 1000}, Size{300, 2},
                                         Size{3, 500}),
                         [](const testing::TestParamInfo<Size>& size) {
                             return std::to_string(size.param.width) + "x" + std::to_string(size.param.height);
                         });

TEST(Terrain, ComesBackWithHeightsAtTheFarEndsOfTheirRange) {
    ScratchFolder folder;
    Terrain terrain = synthetic_terrain(20, 17, no_void);
    for (size_t i = 0; i < terrain.heights.size(); ++i) terrain.heights[i] = i % 3 == 0 ? 1 << 28 : -(1 << 28);
    ASSERT_TRUE(write_file_of(terrain, folder / "a.ovl"));
    Result<Terrain> back = read(folder / "a.ovl");
    ASSERT_TRUE(back) << back.error().message;
    expect_same(*back, terrain);
}

TEST(Terrain, ComesBackWithItsTextureAndWithoutAPlace) {
    ScratchFolder folder;
    Terrain terrain = synthetic_terrain(9, 12, no_void);
    terrain.texture = {5, 2, std::vector<uint8_t>(30, 77)};
    terrain.texture.pixels[29] = 255;
    terrain.frame = {};
    terrain.frame.crs = std::string(32, 'x');  // as long as there is room
    ASSERT_TRUE(write_file_of(terrain, folder / "a.ovl"));
    Result<Terrain> back = read(folder / "a.ovl");
    ASSERT_TRUE(back) << back.error().message;
    expect_same(*back, terrain);
}

TEST(Terrain, IsTheSameBytesWithAnyThreadCount) {
    ScratchFolder folder;
    Terrain terrain = synthetic_terrain(400, 300, [](uint32_t x, uint32_t y) { return x > 370 && y < 90; });
    ASSERT_TRUE(write_file_of(terrain, folder / "one.ovl"));
    for (unsigned threads : {1u, 2u, 7u}) {
        set_thread_count(threads);
        ASSERT_TRUE(write_file_of(terrain, folder / "more.ovl"));
        EXPECT_TRUE(text_of_file(folder / "more.ovl") == text_of_file(folder / "one.ovl")) << threads;
        Result<Terrain> back = read(folder / "more.ovl");
        ASSERT_TRUE(back) << back.error().message;
        expect_same(*back, terrain);
    }
    set_thread_count(0);
}

TEST(Terrain, TakesLessThanTwoBytesASampleOfSmoothGround) {
    ScratchFolder folder;
    Terrain terrain = synthetic_terrain(257, 257, no_void);
    for (uint32_t y = 0; y < 257; ++y)
        for (uint32_t x = 0; x < 257; ++x) terrain.heights[y * 257 + x] = int32_t(x * x / 8 + y * 7);
    Result<uint64_t> bytes = write_file_of(terrain, folder / "a.ovl");
    ASSERT_TRUE(bytes);
    EXPECT_LT(*bytes, 257u * 257 * 2);
}

TEST(TerrainWriter, RefusesWhatNoReaderWouldTake) {
    ScratchFolder folder;
    auto expect_our_bug = [&](auto change) {
        Terrain terrain = synthetic_terrain(5, 4, no_void);
        change(terrain);
        Result<uint64_t> written = write_file_of(terrain, folder / "a.ovl");
        ASSERT_FALSE(written);
        EXPECT_EQ(written.error().exit, Exit::our_bug) << written.error().message;
    };
    expect_our_bug([](Terrain& t) { t.shape.width = 1; });
    expect_our_bug([](Terrain& t) { t.shape.height = 1; });
    expect_our_bug([](Terrain& t) { t.heights.pop_back(); });
    expect_our_bug([](Terrain& t) { t.codes.pop_back(); });
    expect_our_bug([](Terrain& t) { t.codes[0].push_back(0); });
    expect_our_bug([](Terrain& t) { t.frame.crs = std::string(33, 'x'); });
    expect_our_bug([](Terrain& t) { t.frame.crs = "a\tb"; });
    expect_our_bug([](Terrain& t) { t.texture = {2, 2, {1, 2, 3}}; });
    EXPECT_TRUE(folder.names().empty());
}

TEST(TerrainReader, SaysWhatItCouldNotOpen) {
    ScratchFolder folder;
    Result<Terrain> terrain = read(folder / "none.ovl");
    ASSERT_FALSE(terrain);
    EXPECT_EQ(terrain.error().exit, Exit::bad_input);
    EXPECT_EQ(terrain.error().message, folder.path() + "/none.ovl: No such file or directory");
}

}  // namespace
}  // namespace overlook::terrain
