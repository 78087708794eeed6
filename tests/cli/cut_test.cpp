// What the whole path promises, judged by a program that shares no code with it: cuts of baked terrains, sample by sample.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/container.h"
#include "formats/terrain.h"
#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

struct Dem {
    std::string path;
    std::string nodata = "-32768";  // as the file says
    std::string window;             // empty = all
};

std::string bake(const ScratchFolder& folder, const Dem& dem) {
    std::string baked = folder / "baked.ovl";
    std::vector<std::string> words{"bake-lod", "terrain", dem.path, "-o", baked, "--no-texture", "--quiet"};
    if (!dem.window.empty()) words.insert(words.end(), {"--window", dem.window});
    expect_done(run(words));
    return baked;
}

// Exports a cut and has it judged; returns the judgement.
nlohmann::json judged_cut(const ScratchFolder& folder, const std::string& baked, const Dem& dem, const std::string& error_m) {
    std::string ply = folder / "cut.ply";
    expect_done(run({"baked", "export", baked, "--error-m", error_m, "--space", "raster", "-o", ply, "--quiet"}));
    std::vector<std::string> words{"check_cut", ply, dem.path, "--tolerance-m", error_m, "--nodata", dem.nodata};
    if (!dem.window.empty()) words.insert(words.end(), {"--window", dem.window});
    Ran ran = run(words);
    EXPECT_EQ(ran.exit, 0) << "at " << error_m << " m: " << ran.out << ran.err;
    std::remove(ply.c_str());
    return nlohmann::json::parse(ran.out, nullptr, false);
}

// At every tolerance that the project promises, and none coarser has more triangles.
void expect_sound_cuts(const ScratchFolder& folder, const Dem& dem, std::optional<uint64_t> uncovered) {
    std::string baked = bake(folder, dem);
    uint64_t fewest = 0;
    for (const char* error_m : {"100", "50", "20", "5", "1"}) {
        nlohmann::json judgement = judged_cut(folder, baked, dem, error_m);
        ASSERT_TRUE(judgement.is_object());
        EXPECT_GE(judgement["triangles"].get<uint64_t>(), std::max<uint64_t>(2, fewest));
        if (!uncovered) uncovered = judgement["valid_samples_uncovered"].get<uint64_t>();  // the same at every tolerance
        EXPECT_EQ(judgement["valid_samples_uncovered"], *uncovered);
        fewest = judgement["triangles"].get<uint64_t>();
    }
    Ran verified = run({"baked", "verify", baked, "--source", dem.path});
    EXPECT_EQ(verified.exit, 0) << verified.out << verified.err;
}

std::string real_dem(const std::string& name) {
    return dem_folder() + name;
}

#define NEEDS_DATA() \
    if (dem_folder().empty()) GTEST_SKIP() << "set OVERLOOK_DATA to the folder of real elevation models"

TEST(Cut, IsSoundOnTheSample) {
    ScratchFolder folder;
    expect_sound_cuts(folder, {make_dem(folder.path(), 257), "-9999", ""}, 0);
}

TEST(Cut, IsSoundOnASampleWithVoids) {
    ScratchFolder folder;
    Dem dem{make_dem(folder.path(), 257, 40), "-9999", ""};
    expect_sound_cuts(folder, dem, std::nullopt);
}

// Sizes that are no power of two plus one: the squeezed squares at the raster's edges.
TEST(Cut, IsSoundOnPartsOfAnySize) {
    ScratchFolder folder;
    std::string path = make_dem(folder.path(), 129, 12);
    for (const char* window : {"3,5,2,100", "0,0,100,77", "7,2,65,66", "9,9,64,120"}) {
        Dem dem{path, "-9999", window};
        std::string baked = bake(folder, dem);
        for (const char* error_m : {"30", "2"}) judged_cut(folder, baked, dem, error_m);
        EXPECT_EQ(run({"baked", "verify", baked, "--source", path}).exit, 0) << window;
    }
}

TEST(Cut, IsSoundOnEverest) {
    NEEDS_DATA();
    ScratchFolder folder;
    expect_sound_cuts(folder, {real_dem("everest_srtm3_voids.tif"), "-32768", ""}, 451);
}

TEST(Cut, IsSoundOnN44W072) {
    NEEDS_DATA();
    ScratchFolder folder;
    expect_sound_cuts(folder, {real_dem("N44W072.hgt"), "-32768", ""}, 0);
}

TEST(Cut, IsSoundOnBigTujunga) {
    NEEDS_DATA();
    ScratchFolder folder;
    expect_sound_cuts(folder, {real_dem("bigtujunga_utm11.tif"), "32767", ""}, 0);
}

TEST(Cut, IsSoundOnGreenRiver) {
    NEEDS_DATA();
    ScratchFolder folder;
    expect_sound_cuts(folder, {real_dem("greenriver_lidar_1m.tif"), "1.70141000918782799e+38", ""}, 0);
}

TEST(Cut, IsSoundOnTheSmallMercatorRaster) {
    NEEDS_DATA();
    ScratchFolder folder;
    expect_sound_cuts(folder, {real_dem("small_nodata_3857.tif"), "-3.4028234663852886e+38", ""}, 0);
}

// Within 5 % of a right-triangulated irregular network (Evans, Kirkpatrick and Townsend 2001) with certified errors in 8-bit
// codes.
TEST(Cut, HasNoMoreTrianglesThanCertifiedRtin) {
    NEEDS_DATA();
    ScratchFolder folder;
    Dem mountains{real_dem("N44W072.hgt"), "-32768", "0,0,1025,1025"};
    EXPECT_LE(judged_cut(folder, bake(folder, mountains), mountains, "20")["triangles"].get<double>(), 124772 * 1.05);
    Dem river{real_dem("greenriver_lidar_1m.tif"), "1.70141000918782799e+38", "0,0,513,513"};
    EXPECT_LE(judged_cut(folder, bake(folder, river), river, "0.5")["triangles"].get<double>(), 14974 * 1.05);
}

// The same terrain with every stated error halved.
void write_with_lowered_errors(const std::string& from, const std::string& to) {
    auto reader = container::Reader::open(from);
    ASSERT_TRUE(reader) << reader.error().message;
    auto terrain = terrain::read(*reader);
    ASSERT_TRUE(terrain) << terrain.error().message;
    auto provenance = reader->provenance();
    ASSERT_TRUE(provenance) << provenance.error().message;
    for (size_t code = 1; code < terrain::kMustSplit; ++code)
        terrain->error_m[code] = (terrain->error_m[code] + terrain->error_m[0]) / 2;
    auto writer = container::Writer::create(to, terrain::kKind);
    ASSERT_TRUE(writer && terrain::write(*writer, *terrain) && writer->add_provenance(*provenance) && writer->commit());
}

TEST(Verify, SaysNoWhereAStatedErrorIsTooLowAndNamesTheSample) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 129);
    ASSERT_NO_FATAL_FAILURE(write_with_lowered_errors(baked, folder / "lowered.ovl"));
    Ran ran = run({"baked", "verify", folder / "lowered.ovl", "--source", folder / "sample/dem.tif"});
    EXPECT_EQ(ran.exit, 1) << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_NE(ran.out.find("triangles beyond their stated error"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("column "), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find(", row "), std::string::npos) << ran.out;

    Ran json = run({"baked", "verify", folder / "lowered.ovl", "--source", folder / "sample/dem.tif", "--json"});
    EXPECT_EQ(json.exit, 1);
    nlohmann::json proof = nlohmann::json::parse(json.out, nullptr, false);
    ASSERT_TRUE(proof.is_object()) << json.out;
    EXPECT_EQ(proof["holds"], false);
    const nlohmann::json& worst = proof["triangle_violations"]["worst"][0];
    EXPECT_GT(worst["measured_m"].get<double>(), worst["promised_m"].get<double>());
    EXPECT_LT(worst["column"].get<int>(), 129);
}

TEST(Verify, RefusesAnotherSource) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    expect_done(run({"make-sample", "dem", "-o", folder / "other", "--size", "65", "--seed", "2", "--quiet"}));
    expect_refusal(run({"baked", "verify", baked, "--source", folder / "other/dem.tif"}), 3, "baked verify",
                   {folder / "other/dem.tif", "is not what", baked});
}

}  // namespace
}  // namespace overlook::cli
