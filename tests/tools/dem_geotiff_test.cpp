// GeoTIFFs made here, tag by tag: what is read, and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/tools/dem_test_files.h"
#include "tests/tools/tiff_maker.h"

namespace overlook::test {
namespace {

constexpr dem::Options kNone{};
dem::Options with_cells(double size_m) {
    dem::Options options;
    options.cell_size_m = size_m;
    return options;
}

// 3 x 2 samples on UTM 11N, 30 m.
template <class T>
TiffMaker small_utm(std::vector<T> samples, bool is_big_endian = false, bool is_big_tiff = false) {
    TiffMaker tiff(is_big_endian, is_big_tiff);
    tiff.raster<T>(3, 2, samples).grid(500000, 4000000, 30, 30).keys({{1024, 1}, {1025, 1}, {3072, 32611}, {3076, 9001}});
    return tiff;
}

template <class T>
void expect_samples_of(const std::vector<T>& samples, bool is_big_endian, bool is_big_tiff) {
    const Scratch scratch;
    const std::string path = scratch.write("a.tif", small_utm<T>(samples, is_big_endian, is_big_tiff).bytes());
    const Result<dem::Raster> raster = dem::open(path, kNone);
    ASSERT_TRUE(raster) << raster.error().message;
    ASSERT_EQ(raster->width, 3u);
    ASSERT_EQ(raster->height, 2u);
    EXPECT_EQ(raster->samples_are_integers, !std::is_floating_point_v<T>);
    for (size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(raster->samples[i], float(samples[i])) << i;
    EXPECT_EQ(raster->source_name, "a.tif");
    EXPECT_EQ(raster->source_hash.size(), 32u);
}

TEST(GeoTiff, KeepsStoredValuesOfEveryTypeAndByteOrder) {
    for (const bool is_big_endian : {false, true})
        for (const bool is_big_tiff : {false, true}) {
            expect_samples_of<int16_t>({-32768, -1, 0, 1, 255, 32767}, is_big_endian, is_big_tiff);
            expect_samples_of<uint16_t>({0, 1, 2, 32768, 65534, 65535}, is_big_endian, is_big_tiff);
            expect_samples_of<uint8_t>({0, 1, 2, 127, 128, 255}, is_big_endian, is_big_tiff);
            expect_samples_of<int8_t>({-128, -1, 0, 1, 2, 127}, is_big_endian, is_big_tiff);
            expect_samples_of<float>({-1e5f, -0.25f, 0, 1.5f, 3.14159274f, 8848.86f}, is_big_endian, is_big_tiff);
        }
}

TEST(GeoTiff, TurnsNodataAndNanIntoVoids) {
    const Scratch scratch;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto voids = [&](TiffMaker tiff, const dem::Options& options) {
        const Result<dem::Raster> raster = dem::open(scratch.write("v.tif", tiff.bytes()), options);
        EXPECT_TRUE(raster) << (raster ? "" : raster.error().message);
        return raster ? int(raster->void_count) : -1;
    };
    EXPECT_EQ(voids(small_utm<int16_t>({-32768, 1, 2, -32768, 3, 4}).text(42113, "-32768"), kNone), 2);
    EXPECT_EQ(voids(small_utm<float>({1.70141000918782799e+38f, 1, 2, 3, nan, 5}).text(42113, "1.70141000918782799e+38"), kNone),
              2);
    EXPECT_EQ(voids(small_utm<float>({-3.4028234663852886e+38f, 1, 2, 3, 4, 5}).text(42113, "-3.4028234663852886e+38"), kNone),
              1);
    EXPECT_EQ(voids(small_utm<float>({-std::numeric_limits<float>::infinity(), 1, 2, 3, 4, 5}).text(42113, "-inf"), kNone), 1);
    EXPECT_EQ(voids(small_utm<float>({nan, 1, 2, 3, 4, 5}).text(42113, "nan"), kNone), 1);
    EXPECT_EQ(voids(small_utm<float>({0.1f, 1, 2, 3, 4, 5}).text(42113, "0.1"), kNone), 1);
    EXPECT_EQ(voids(small_utm<uint8_t>({0, 1, 2, 3, 4, 5}).text(42113, "-9999"), kNone), 0);
    dem::Options nodata_is_7;
    nodata_is_7.nodata = 7;
    EXPECT_EQ(voids(small_utm<int16_t>({-999, 7, 7, 7, 3, 4}).text(42113, "-999"), nodata_is_7), 3);
}

TEST(GeoTiff, RefusesWhatIsNoHeight) {
    const Scratch scratch;
    const auto refused = [&](TiffMaker tiff, const std::string& words) {
        expect_refused(scratch.write("h.tif", tiff.bytes()), kNone, Exit::bad_input, words);
    };
    refused(small_utm<float>({1, 2, 3, 4, -3.4e38f, 6}), "column 1, row 1 stores -3.4e+38");
    refused(small_utm<float>({1, 2, std::numeric_limits<float>::infinity(), 4, 5, 6}), "--nodata inf");
    refused(small_utm<int16_t>({9, 9, 9, 9, 9, 9}).text(42113, "9"), "all of its 3 x 2 samples are void");
    refused(small_utm<int16_t>({1, 2, 3, 4, 5, 6}).text(42113, "none"), "\"none\", which is not a number");
}

TEST(GeoTiff, TakesHeightsInFeet) {
    const Scratch scratch;
    const auto scale = [&](const std::vector<std::pair<uint16_t, uint16_t>>& vertical, const dem::Options& options) {
        std::vector<std::pair<uint16_t, uint16_t>> keys{{1024, 1}, {1025, 1}, {3072, 32611}};
        keys.insert(keys.end(), vertical.begin(), vertical.end());
        const Result<dem::Raster> raster =
            dem::open(scratch.write("f.tif", small_utm<int16_t>({1, 2, 3, 4, 5, 6}).keys(keys).bytes()), options);
        EXPECT_TRUE(raster) << (raster ? "" : raster.error().message);
        return raster ? raster->height_scale_m : 0;
    };
    dem::Options doubled;
    doubled.height_scale_m = 2;
    EXPECT_EQ(scale({}, kNone), 1);
    EXPECT_EQ(scale({{4099, 9001}}, kNone), 1);
    EXPECT_EQ(scale({{4099, 9002}}, kNone), 0.3048);
    EXPECT_EQ(scale({{4099, 9003}}, kNone), 1200.0 / 3937.0);
    EXPECT_EQ(scale({{4096, 6360}}, kNone), 1200.0 / 3937.0);
    EXPECT_EQ(scale({{4099, 9002}}, doubled), 2);
    expect_refused(scratch.write("u.tif", small_utm<int16_t>({1, 2, 3, 4, 5, 6}).keys({{3072, 32611}, {4099, 9036}}).bytes()),
                   kNone, Exit::bad_input, "unit 9036");
}

TEST(GeoTiff, ReadsWindowsOfStripsAsOfTheWhole) {
    const Scratch scratch;
    std::vector<int16_t> samples;
    for (int i = 0; i < 50 * 40; ++i) samples.push_back(int16_t(i * 7 % 1000));
    TiffMaker tiff;
    tiff.raster<int16_t>(50, 40, samples);
    const std::string path = scratch.write("w.tif", tiff.bytes());
    dem::Options options = with_cells(1);
    options.window = dem::Window{7, 11, 30, 20};
    const Result<dem::Raster> part = dem::open(path, options);
    ASSERT_TRUE(part) << part.error().message;
    ASSERT_EQ(part->samples.size(), 600u);
    for (uint32_t row = 0; row < 20; ++row)
        for (uint32_t column = 0; column < 30; ++column)
            ASSERT_EQ(part->samples[row * 30 + column], samples[(row + 11) * 50 + column + 7]) << column << " " << row;
    options.window = dem::Window{21, 0, 30, 20};
    expect_refused(path, options, Exit::bad_input, "which has 50 x 40 samples");
    options.window = dem::Window{0xffffffff, 0, 2, 2};
    expect_refused(path, options, Exit::bad_input, "which has 50 x 40 samples");
    options.window = dem::Window{0, 0, 1, 20};
    expect_refused(path, options, Exit::bad_input, "1 x 20 samples are too few");
}

TEST(GeoTiff, MirrorsRastersThatAreStoredSouthFirstOrWestward) {
    const Scratch scratch;
    const auto samples = [&](double column_x, double row_y) {
        TiffMaker tiff = small_utm<int16_t>({1, 2, 3, 4, 5, 6});
        tiff.without(33550).without(33922).doubles(34264, {column_x, 0, 0, 500000, 0, row_y, 0, 4e6, 0, 0, 0, 0, 0, 0, 0, 1});
        const Result<dem::Raster> raster = dem::open(scratch.write("m.tif", tiff.bytes()), kNone);
        EXPECT_TRUE(raster) << (raster ? "" : raster.error().message);
        EXPECT_NEAR(raster->frame.convergence_deg, 0, 0.01);
        return raster->samples;
    };
    EXPECT_EQ(samples(30, -30), (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(samples(30, 30), (std::vector<float>{4, 5, 6, 1, 2, 3}));
    EXPECT_EQ(samples(-30, -30), (std::vector<float>{3, 2, 1, 6, 5, 4}));
    EXPECT_EQ(samples(-30, 30), (std::vector<float>{6, 5, 4, 3, 2, 1}));
}

TEST(GeoTiff, TakesGdalsScaleAndOffset) {
    const Scratch scratch;
    const auto opened = [&](const std::string& items, const dem::Options& options) {
        return dem::open(
            scratch.write(
                "s.tif",
                small_utm<int16_t>({1, 2, 3, 4, 5, 6}).text(42112, "<GDALMetadata>" + items + "</GDALMetadata>").bytes()),
            options);
    };
    const std::string scale = "<Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.1</Item>",
                      offset = "<Item name=\"OFFSET\" sample=\"0\" role=\"offset\">-100</Item>",
                      other = "<Item name=\"SCALE\" sample=\"1\" role=\"scale\">7</Item><Item name=\"AREA_OR_POINT\">Area</Item>";
    const Result<dem::Raster> both = opened(other + scale + offset, kNone);
    ASSERT_TRUE(both);
    EXPECT_EQ(both->height_scale_m, 0.1);
    EXPECT_EQ(both->height_offset_m, -100);
    EXPECT_EQ(opened(other, kNone)->height_scale_m, 1);
    dem::Options doubled;
    doubled.height_scale_m = 2;
    EXPECT_EQ(opened(scale + offset, doubled)->height_scale_m, 2);
    EXPECT_EQ(opened(scale + offset, doubled)->height_offset_m, 0);
    for (const char* words : {"zero", "0", "", "1e999", "1 m"}) {
        const Result<dem::Raster> broken = opened("<Item role=\"scale\">" + std::string(words) + "</Item>", kNone);
        ASSERT_FALSE(broken) << words;
        EXPECT_NE(broken.error().message.find("GDAL_METADATA gives a scale"), std::string::npos);
    }
}

TEST(GeoTiff, RefusesFormsThatAreNoElevationModel) {
    const Scratch scratch;
    const std::vector<int16_t> six{1, 2, 3, 4, 5, 6};
    const auto refused = [&](const TiffMaker& tiff, const std::string& words) {
        expect_refused(scratch.write("r.tif", tiff.bytes()), kNone, Exit::bad_input, words);
    };
    TiffMaker narrow;
    narrow.raster<int16_t>(1, 6, six);
    refused(narrow, "1 x 6 samples are too few");
    TiffMaker picture;
    picture.raster<uint8_t>(4, 2, std::vector<uint8_t>(24)).shorts(277, {3}).shorts(258, {8, 8, 8}).shorts(262, {2});
    refused(picture, "has 3 channels");
    TiffMaker doubles;
    doubles.raster<double>(2, 2, {1, 2, 3, 4});
    refused(doubles, "64-bit floats");
    TiffMaker longs;
    longs.raster<int32_t>(2, 2, {1, 2, 3, 4});
    refused(longs, "32-bit integers");
    refused(small_utm(six).shorts(262, {0}), "white as zero");
    refused(small_utm(six).shorts(262, {3}), "samples are colours");
    refused(small_utm(six).shorts(274, {3}), "rows do not run from the top left");
}

TEST(GeoTiff, RefusesUnknownReferencesAndTakesACellSizeInstead) {
    const Scratch scratch;
    const std::vector<int16_t> six{1, 2, 3, 4, 5, 6};
    const auto refused = [&](const TiffMaker& tiff, const std::string& words) {
        const std::string path = scratch.write("c.tif", tiff.bytes());
        expect_refused(path, kNone, Exit::bad_input, words);
        expect_refused(path, kNone, Exit::bad_input, "--cell-size-m");
        const Result<dem::Raster> raster = dem::open(path, with_cells(12.5));
        ASSERT_TRUE(raster) << raster.error().message;
        EXPECT_EQ(raster->frame.metres_per_column, 12.5);
        EXPECT_EQ(raster->frame.metres_per_row, 12.5);
        EXPECT_FALSE(raster->frame.is_georeferenced);
    };
    refused(small_utm(six).keys({{1024, 1}, {3072, 2154}}), "EPSG:2154");
    refused(small_utm(six).keys({{1024, 1}, {3072, 32767}}), "user-defined");
    refused(small_utm(six).keys({{1024, 2}, {2048, 4999}}), "EPSG:4999");
    refused(small_utm(six).keys({{1024, 3}, {2048, 4326}}), "GTModelType 3");
    refused(small_utm(six).without(34735), "has no coordinate reference system");
    refused(small_utm(six).without(33550), "no grid");
    refused(small_utm(six).without(33550).doubles(33922, std::vector<double>(24)), "4 control points");
    refused(small_utm(six).grid(0, 0, 0, 30), "a step of its grid is zero");
}

TEST(GeoTiff, RefusesGridsWithoutRightAngles) {
    const Scratch scratch;
    const auto with_transform = [&](double cx, double rx, double cy, double ry, uint16_t code, uint16_t key) {
        TiffMaker tiff = small_utm<int16_t>({1, 2, 3, 4, 5, 6});
        tiff.without(33550)
            .without(33922)
            .doubles(34264, {cx, rx, 0, 10, cy, ry, 0, 20, 0, 0, 0, 0, 0, 0, 0, 1})
            .keys({{key, code}});
        return scratch.write("g.tif", tiff.bytes());
    };
    expect_refused(with_transform(30, 10, 0, -30, 32611, 3072), kNone, Exit::bad_input, "sheared");
    expect_refused(with_transform(0.1, 0.1, 0.1, -0.1, 4326, 2048), kNone, Exit::bad_input, "is turned by 45 degrees");
    expect_refused(with_transform(1, 0, 0, -100, 4326, 2048), kNone, Exit::bad_input, "latitude");
}

}  // namespace
}  // namespace overlook::test
