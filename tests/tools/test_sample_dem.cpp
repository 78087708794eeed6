#include "tools/make_sample/sample_dem.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "formats/scene.h"
#include "tools/make_sample/geotiff.h"

namespace overlook::sample {
namespace {

// What a reader needs of a little-endian TIFF, written from the standard and not from the writer.
struct Tiff {
    std::vector<std::byte> bytes;
    struct Entry {
        uint32_t type = 0, count = 0, value_at = 0;
    };
    std::map<uint32_t, Entry> entries;
    bool tags_ascend = true;

    uint32_t number(size_t at, size_t size) const {
        uint32_t value = 0;
        for (size_t i = 0; i < size; ++i) value |= uint32_t(bytes.at(at + i)) << (8 * i);
        return value;
    }
    uint32_t whole(uint32_t tag, uint32_t i) const {
        const Entry& entry = entries.at(tag);
        size_t size = entry.type == 3 ? 2 : 4;
        return number(entry.value_at + i * size, size);
    }
    double real(uint32_t tag, uint32_t i) const {
        uint32_t at = entries.at(tag).value_at + 8 * i;
        return std::bit_cast<double>(uint64_t(number(at, 4)) | uint64_t(number(at + 4, 4)) << 32);
    }
};

Tiff parse(std::vector<std::byte> bytes) {
    Tiff tiff{std::move(bytes), {}, true};
    uint32_t at = tiff.number(4, 4), count = tiff.number(at, 2), before = 0;
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t entry = at + 2 + 12 * i, tag = tiff.number(entry, 2), type = tiff.number(entry + 2, 2);
        uint32_t values = tiff.number(entry + 4, 4), size = values * (type == 3 ? 2 : type == 4 ? 4 : type == 12 ? 8 : 1);
        tiff.entries[tag] = {type, values, size <= 4 ? entry + 8 : tiff.number(entry + 8, 4)};
        tiff.tags_ascend = tiff.tags_ascend && tag > before;
        before = tag;
    }
    return tiff;
}

std::vector<float> samples_of(const Tiff& tiff) {
    std::vector<float> samples;
    for (uint32_t strip = 0; strip < tiff.entries.at(273).count; ++strip)
        for (uint32_t i = 0; i < tiff.whole(279, strip) / 4; ++i)
            samples.push_back(std::bit_cast<float>(tiff.number(tiff.whole(273, strip) + 4 * i, 4)));
    return samples;
}

std::vector<std::byte> file_bytes(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    std::vector<std::byte> bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

std::string fresh_folder(const std::string& name) {
    std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("overlook_sample_" + name);
    std::filesystem::remove_all(folder);
    return folder.string();
}

DemOptions tiny() {
    DemOptions options;
    options.landscape.side = 65;
    options.landscape.cell_size_m = 90;
    return options;
}

TEST(GeoTiff, HoldsTheSamplesInItsStrips) {
    uint32_t width = 5000, height = 11;  // three rows a strip, the last one shorter
    std::vector<float> samples(size_t(width) * height);
    for (size_t i = 0; i < samples.size(); ++i) samples[i] = float(i) * 0.25f;
    Tiff tiff = parse(geotiff_bytes(samples, width, height, {}, std::nullopt));
    EXPECT_EQ(tiff.number(0, 4), 0x002a4949u);
    EXPECT_TRUE(tiff.tags_ascend);
    EXPECT_EQ(tiff.whole(256, 0), width);
    EXPECT_EQ(tiff.whole(257, 0), height);
    EXPECT_EQ(tiff.whole(258, 0), 32u);
    EXPECT_EQ(tiff.whole(339, 0), 3u);
    EXPECT_EQ(tiff.entries.at(273).count, 4u);
    EXPECT_EQ(samples_of(tiff), samples);
    EXPECT_FALSE(tiff.entries.contains(42113));
}

TEST(GeoTiff, OfOneSampleHoldsIt) {
    std::vector<float> samples = {12.5f};
    EXPECT_EQ(samples_of(parse(geotiff_bytes(samples, 1, 1, {}, std::nullopt))), samples);
}

TEST(GeoTiff, SaysWhereItLies) {
    std::vector<float> samples(12, 1.0f);
    Tiff tiff = parse(geotiff_bytes(samples, 4, 3, {32633, 400000, 5300000, 12.5}, -9999));
    EXPECT_EQ(tiff.real(33550, 0), 12.5);
    EXPECT_EQ(tiff.real(33550, 1), 12.5);
    EXPECT_EQ(tiff.real(33922, 3), 400000);
    EXPECT_EQ(tiff.real(33922, 4), 5300000);
    ASSERT_EQ(tiff.entries.at(34735).count, 16u);
    EXPECT_EQ(tiff.whole(34735, 3), 3u);   // keys
    EXPECT_EQ(tiff.whole(34735, 7), 1u);   // projected
    EXPECT_EQ(tiff.whole(34735, 11), 2u);  // pixel is point
    EXPECT_EQ(tiff.whole(34735, 15), 32633u);
    uint32_t text = tiff.entries.at(42113).value_at;
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(&tiff.bytes[text])), "-9999");
}

TEST(SampleDem, WritesWhatTheLandscapeIs) {
    std::string folder = fresh_folder("plain");
    Result<DemReport> report = make_dem(tiny(), folder);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(samples_of(parse(file_bytes(folder + "/dem.tif"))), make_landscape(tiny().landscape).height_m);
    EXPECT_EQ(report->void_samples, 0u);
    ASSERT_EQ(report->files.size(), 4u);
    for (const std::string& file : report->files) EXPECT_TRUE(std::filesystem::exists(file)) << file;
    EXPECT_TRUE(scene::read_scene(folder + "/scene.json"));
    EXPECT_TRUE(scene::read_flight(folder + "/flight.json"));
}

TEST(SampleDem, DigsTheVoidsItReportsAndLeavesTheRest) {
    std::string folder = fresh_folder("voids");
    DemOptions options = tiny();
    options.void_count = 6;
    Result<DemReport> report = make_dem(options, folder);
    ASSERT_TRUE(report) << report.error().message;
    Tiff tiff = parse(file_bytes(folder + "/dem.tif"));
    EXPECT_TRUE(tiff.entries.contains(42113));
    std::vector<float> samples = samples_of(tiff), whole = make_landscape(options.landscape).height_m;
    uint64_t voids = 0;
    for (size_t i = 0; i < whole.size(); ++i) {
        voids += samples[i] == float(kNodata);
        EXPECT_TRUE(samples[i] == float(kNodata) || samples[i] == whole[i]);
    }
    EXPECT_GT(voids, 0u);
    EXPECT_EQ(voids, report->void_samples);
}

TEST(SampleDem, RefusesWhatItCannotMake) {
    DemOptions options = tiny();
    options.landscape.side = 20;
    Result<DemReport> report = make_dem(options, fresh_folder("refused"));
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().exit, Exit::bad_command);
    EXPECT_EQ(report.error().message, "--size 20 is outside 33..4097");
    options = tiny();
    options.landscape.cell_size_m = std::bit_cast<double>(0x7ff8000000000000u);  // not a number
    EXPECT_FALSE(make_dem(options, fresh_folder("refused")));
    EXPECT_FALSE(std::filesystem::exists(fresh_folder("refused")));
}

TEST(SampleDem, SaysWhyTheFolderCannotBe) {
    std::string folder = fresh_folder("in_the_way");
    std::ofstream(folder) << "a file";
    Result<DemReport> report = make_dem(tiny(), folder + "/below");
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().exit, Exit::cannot_write);
    EXPECT_NE(report.error().message.find("Not a directory"), std::string::npos) << report.error().message;
}

}  // namespace
}  // namespace overlook::sample
