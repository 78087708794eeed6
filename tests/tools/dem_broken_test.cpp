// Damaged GeoTIFFs: refused in one line, never read as zeros, nothing printed.

#include <gtest/gtest.h>

#include <random>

#include "tests/tools/dem_test_files.h"
#include "tests/tools/tiff_maker.h"

namespace overlook::test {
namespace {

constexpr dem::Options kNone{};

TiffMaker small(bool is_big_tiff = false) {
    std::vector<int16_t> samples;
    for (int i = 0; i < 20 * 10; ++i) samples.push_back(int16_t(i + 1));
    TiffMaker tiff(false, is_big_tiff);
    tiff.raster<int16_t>(20, 10, samples).grid(500000, 4e6, 30, 30).keys({{1024, 1}, {1025, 1}, {3072, 32611}});
    return tiff;
}

TEST(BrokenGeoTiff, IsRefusedAtEveryTruncatedLength) {
    const Scratch scratch;
    for (const bool is_big_tiff : {false, true}) {
        const std::string whole = small(is_big_tiff).bytes();
        ASSERT_TRUE(dem::open(scratch.write("whole.tif", whole), kNone));
        for (size_t length = 0; length < whole.size(); ++length)
            ASSERT_NO_FATAL_FAILURE(
                expect_refused(scratch.write("cut.tif", whole.substr(0, length)), kNone, Exit::bad_input, "cut.tif: "));
    }
}

TEST(BrokenGeoTiff, RealFilesAreRefusedAtEveryFortiethOfTheirLength) {
    const Scratch scratch;
    for (const char* file : {"dem/everest_srtm3_voids.tif", "dem/greenriver_lidar_1m.tif", "dem/small_nodata_3857.tif",
                             "dem/bigtujunga_utm11.tif"}) {
        const std::string path = data_file(file);
        OVERLOOK_NEED_DATA(path);
        const std::string whole = file_bytes(path);
        // GDAL may end a file with four bytes after its last tile.
        for (size_t part = 0; part < 40; ++part)
            expect_refused(scratch.write("cut.tif", whole.substr(0, whole.size() * part / 40)), kNone, Exit::bad_input,
                           "cut.tif: ");
        expect_refused(scratch.write("cut.tif", whole.substr(0, whole.size() - 5)), kNone, Exit::bad_input, "cut.tif: ");
    }
}

TEST(BrokenGeoTiff, DamagedCompressedTilesAreRefusedWithoutPrinting) {
    const Scratch scratch;
    const std::string path = data_file("dem/greenriver_lidar_1m.tif");
    OVERLOOK_NEED_DATA(path);
    std::string bytes = file_bytes(path);
    for (size_t i = 147017; i < 147017 + 4000; ++i) bytes[i] = '\xff';
    expect_refused(scratch.write("damaged.tif", bytes), kNone, Exit::bad_input, "cannot be decoded");
}

TEST(BrokenGeoTiff, RefusesLyingTags) {
    const Scratch scratch;
    const auto refused = [&](const TiffMaker& tiff, const std::string& words, Exit exit = Exit::bad_input) {
        expect_refused(scratch.write("lie.tif", tiff.bytes()), kNone, exit, words);
    };
    refused(small().longs(256, {0}), "TIFF tag 256 (ImageWidth) is 0");
    refused(small().without(257), "TIFF tag 257 (ImageLength) is 0");
    refused(small().longs(256, {4000000000u}), "TIFF tag 256 (ImageWidth)");
    refused(small().longs(256, {2000000000u}).longs(257, {2000000000u}).longs(278, {2000000000u}), "too few for its");
    refused(small().longs(257, {2000000000u}).longs(278, {1}), "the file lists 1");
    refused(small().longs(278, {3}), "needs 4 of them, the file lists 1");
    refused(small().longs(279, {399}), "TIFF strip 0 has 399 bytes, too few");
    refused(small().longs(279, {0}), "TIFF strip 0 is empty");
    refused(small().longs(279, {0xffffffff}), "was the copy cut short?");
    refused(small().longs(273, {0xfffffff0}), "was the copy cut short?");
    refused(small().longs(322, {16}), "TIFF tag 323 (TileLength) is 0");
    refused(small().text(256, "20"), "which is not a whole number's");
    refused(small().shorts(339, {9}), "TIFF tag 339 (SampleFormat) is 9");
    refused(small().doubles(33550, {1, 2}), "TIFF tag 33550 (ModelPixelScale) has 2 values");
    refused(small().doubles(33550, {std::nan(""), 2, 0}), "holds a value that is not a number");
    refused(small().doubles(33922, {1, 2, 3}), "TIFF tag 33922 (ModelTiepoint) has 3 values");
    refused(small().shorts(34735, {1, 1, 0}), "fewer than its head of 4");
    refused(small().shorts(34735, {1, 1, 0, 65535}), "announces 65535 keys");
    refused(small().shorts(34735, {1, 1, 0, 1, 2057, 34736, 1, 7}), "points outside tag 34736");
    refused(small().shorts(259, {5}), "cannot be decoded");
    refused(small().shorts(259, {60000}), "cannot be decoded");
}

TEST(BrokenGeoTiff, MoreSamplesThanFitAreImpossible) {
    const Scratch scratch;
    // 65,535 columns of one-byte samples in 65,535 strips that are all the same bytes: 4.3e9 samples in a small file.
    const uint32_t side = 65535;
    TiffMaker tiff;
    tiff.raster<uint8_t>(side, 1, std::vector<uint8_t>(side)).longs(257, {side}).longs(278, {1});
    tiff.longs(279, std::vector<uint32_t>(side, side)).longs(273, std::vector<uint32_t>(side, 8)).without(33550);
    tiff.grid(500000, 4e6, 1, 1).keys({{3072, 32611}});
    expect_refused(scratch.write("big.tif", tiff.bytes()), kNone, Exit::impossible, "--window");
}

// Whatever byte is wrong, a reader answers; the seed is fixed so that a failure repeats.
TEST(BrokenGeoTiff, SurvivesAnyChangedByteOfItsHead) {
    const Scratch scratch;
    const std::string whole = small().bytes();
    std::mt19937 random(7);
    testing::internal::CaptureStderr();
    size_t refused = 0;
    for (size_t at = 0; at < whole.size() - 400; ++at) {
        std::string bytes = whole;
        bytes[at] = char(random() & 255);
        refused += !dem::open(scratch.write("changed.tif", bytes), kNone);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_GT(refused, 20u);
}

}  // namespace
}  // namespace overlook::test
