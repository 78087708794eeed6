// SRTM tiles, grey PNGs, pictures, and files that are neither.

#include <gtest/gtest.h>

#include "tests/tools/dem_test_files.h"
#include "tests/tools/png_maker.h"
#include "tools/bake/images.h"

namespace overlook::test {
namespace {

constexpr dem::Options kNone{};
dem::Options with_cells(double size_m) {
    dem::Options options;
    options.cell_size_m = size_m;
    return options;
}

// A 3 x 3 tile: 256 * i + 1, the middle void.
std::string small_tile() {
    std::string bytes;
    for (int i = 0; i < 9; ++i) bytes += i == 4 ? std::string{char(0x80), 0} : std::string{char(i), 1};
    return bytes;
}

TEST(SrtmTile, IsBigEndianWithVoidsOnItsCorners) {
    const Scratch scratch;
    const Result<dem::Raster> raster = dem::open(scratch.write("s01e010.SRTMGL1.HGT", small_tile()), kNone);
    ASSERT_TRUE(raster) << raster.error().message;
    EXPECT_EQ(raster->width, 3u);
    EXPECT_EQ(raster->samples[0], 1);
    EXPECT_EQ(raster->samples[8], 8 * 256 + 1);
    EXPECT_EQ(raster->void_count, 1u);
    EXPECT_NE(raster->samples[4], raster->samples[4]);
    EXPECT_NEAR(raster->frame.centre_latitude_deg, -0.5, 1e-12);
    EXPECT_NEAR(raster->frame.centre_longitude_deg, 10.5, 1e-12);
}

TEST(SrtmTile, WindowMovesItsMiddle) {
    const Scratch scratch;
    dem::Options options;
    options.window = dem::Window{1, 1, 2, 2};
    const Result<dem::Raster> raster = dem::open(scratch.write("N44W072.hgt", small_tile()), options);
    ASSERT_TRUE(raster) << raster.error().message;
    EXPECT_EQ(raster->samples[3], 8 * 256 + 1);
    EXPECT_NEAR(raster->frame.centre_latitude_deg, 44.25, 1e-12);
    EXPECT_NEAR(raster->frame.centre_longitude_deg, -71.25, 1e-12);
}

TEST(SrtmTile, RefusesLengthsThatAreNoSquare) {
    const Scratch scratch;
    const std::string tile = small_tile();
    for (const size_t length : {1u, 2u, 7u, 9u, 16u, 17u})
        expect_refused(scratch.write("N44W072.hgt", tile.substr(0, length)), kNone, Exit::bad_input,
                       "no square of 16-bit samples");
    expect_refused(scratch.write("N44W072.hgt", ""), kNone, Exit::bad_input, "is empty");
}

TEST(SrtmTile, RefusesNamesWithoutAPlace) {
    const Scratch scratch;
    for (const std::string name : {"tile.hgt", "N4xW072.hgt", "N44W072x.hgt", "N90W072.hgt", "N44W181.hgt", "X44W072.hgt"}) {
        const std::string path = scratch.write(name, small_tile());
        expect_refused(path, kNone, Exit::bad_input, "--cell-size-m");
        const Result<dem::Raster> raster = dem::open(path, with_cells(30));
        ASSERT_TRUE(raster) << raster.error().message;
        EXPECT_EQ(raster->frame.metres_per_row, 30);
    }
}

TEST(GreyPng, KeepsStoredValuesOf8And16Bits) {
    const Scratch scratch;
    const Result<dem::Raster> bytes =
        dem::open(scratch.write("a.png", make_png(3, 2, 8, 0, std::string("\x00\x01\x7f\x80\xfe\xff", 6))), with_cells(5));
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(bytes->samples, (std::vector<float>{0, 1, 127, 128, 254, 255}));
    dem::Options options = with_cells(5);
    options.height_scale_m = 0.5;
    const Result<dem::Raster> words =
        dem::open(scratch.write("b.png", make_png(2, 2, 16, 0, std::string("\x00\x01\x01\x00\x80\x01\xff\xfe", 8))), options);
    ASSERT_TRUE(words) << words.error().message;
    EXPECT_EQ(words->samples, (std::vector<float>{1, 256, 32769, 65534}));
    EXPECT_EQ(words->height_scale_m, 0.5);
    EXPECT_EQ(words->frame.metres_per_column, 5);
    EXPECT_TRUE(words->samples_are_integers);
}

TEST(GreyPng, RefusesWhatIsNoHeight) {
    const Scratch scratch;
    const auto refused = [&](const std::string& bytes, const dem::Options& options, const std::string& words) {
        expect_refused(scratch.write("p.png", bytes), options, Exit::bad_input, words);
    };
    const std::string six(6, '\x40'), palette = png_chunk("PLTE", std::string("abcdef"));
    refused(make_png(3, 2, 8, 0, six), kNone, "--cell-size-m");
    refused(make_png(2, 2, 8, 2, six + six), with_cells(1), "is a PNG with colours");
    refused(make_png(3, 2, 8, 4, six + six), with_cells(1), "is a PNG with alpha");
    refused(make_png(3, 2, 8, 3, std::string(6, '\1'), palette), with_cells(1), "palette");
    refused(make_png(8, 2, 1, 0, "ab"), with_cells(1), "has 1 bits a sample");
    refused(make_png(3, 2, 8, 0, six, png_chunk("tRNS", std::string("\0\1", 2))), with_cells(1), "2 channels");
    const std::string whole = make_png(3, 2, 8, 0, six);
}

TEST(GreyPng, IsRefusedAtEveryTruncatedLengthAndWithAnyDamagedByte) {
    const Scratch scratch;
    const std::string whole = make_png(3, 2, 8, 0, "abcdef");
    ASSERT_TRUE(dem::open(scratch.write("whole.png", whole), with_cells(1)));
    for (size_t at = 0; at < whole.size(); ++at) {
        expect_refused(scratch.write("cut.png", whole.substr(0, at)), with_cells(1), Exit::bad_input, "cut.png: ");
        std::string damaged = whole;
        damaged[at] = char(damaged[at] ^ 0x10);
        expect_refused(scratch.write("damaged.png", damaged), with_cells(1), Exit::bad_input, "damaged.png: ");
    }
}

TEST(ElevationModel, RefusesFilesOfOtherForms) {
    const Scratch scratch;
    expect_refused(scratch.path("missing.tif"), kNone, Exit::bad_input, "No such file");
    expect_refused(scratch.write("empty.tif", ""), kNone, Exit::bad_input, "is empty");
    expect_refused(scratch.write("text.tif", "ncols 4\nnrows 4\n"), kNone, Exit::bad_input,
                   "GeoTIFF (.tif), SRTM (.hgt), grey PNG (.png)");
    expect_refused(scratch.write("a.asc", "ncols 4\nnrows 4\n"), kNone, Exit::bad_input,
                   "GeoTIFF (.tif), SRTM (.hgt), grey PNG (.png)");
    expect_refused(scratch.path(""), kNone, Exit::bad_input, "");
}

TEST(Picture, IsSpreadToRgbWithoutAlpha) {
    const Scratch scratch;
    const auto pixels = [&](const std::string& png) {
        const Result<ImageRgb8> picture = read_image_rgb8(scratch.write("p.png", png));
        EXPECT_TRUE(picture) << (picture ? "" : picture.error().message);
        return picture ? picture->pixels : std::vector<uint8_t>();
    };
    EXPECT_EQ(pixels(make_png(2, 1, 8, 2, "abcdef")), (std::vector<uint8_t>{'a', 'b', 'c', 'd', 'e', 'f'}));
    EXPECT_EQ(pixels(make_png(2, 1, 8, 0, "ab")), (std::vector<uint8_t>{'a', 'a', 'a', 'b', 'b', 'b'}));
    EXPECT_EQ(pixels(make_png(1, 1, 8, 6, std::string("abc\x10", 4))), (std::vector<uint8_t>{'a', 'b', 'c'}));
    EXPECT_EQ(pixels(make_png(1, 1, 16, 0, std::string("\x80\x00", 2))), (std::vector<uint8_t>{128, 128, 128}));
    EXPECT_EQ(pixels(make_png(1, 1, 8, 3, std::string(1, '\1'), png_chunk("PLTE", "abcdef"))),
              (std::vector<uint8_t>{'d', 'e', 'f'}));
}

TEST(Picture, RefusesWhatDoesNotDecodeWithoutPrinting) {
    const Scratch scratch;
    testing::internal::CaptureStderr();
    const std::string whole = make_png(20, 20, 8, 0, std::string(400, 'x'));
    EXPECT_FALSE(read_image_rgb8(scratch.path("missing.png")));
    EXPECT_FALSE(read_image_rgb8(scratch.write("text.png", "no picture")));
    EXPECT_FALSE(read_image_rgb8(scratch.write("text.jpg", "no picture")));
    EXPECT_FALSE(read_image_rgb8(scratch.write("text.xyz", "no picture")));
    EXPECT_FALSE(read_image_rgb8(scratch.write("text", "no picture")));
    EXPECT_FALSE(read_image_rgb8(scratch.write("cut.png", whole.substr(0, whole.size() / 2))));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace overlook::test
