// measure as a program: what it refuses, and a whole tiny run.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

using Words = std::vector<std::string>;

const std::string kFlight = R"({"version": 1, "interpolation": "linear", "step_s": 0.5, "keys": [
  {"time_s": 0, "position_m": [300, -1500, 900], "heading_deg": 0, "pitch_deg": -30},
  {"time_s": 1.5, "position_m": [330, -1480, 900], "heading_deg": 2, "pitch_deg": -30}]})";

class Measure : public testing::Test {
  protected:
    ScratchFolder folder_;
    std::string baked_ = make_baked(folder_.path(), 65);
    std::string flight_ = folder_ / "f.json";
    void SetUp() override { write_text(flight_, kFlight); }

    Words words(const Words& more) const {
        Words all = {"measure", baked_, "--flight", flight_, "--size", "64x64", "--out", folder_ / "out"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void expect_refused(const Words& all, int exit, const std::vector<std::string>& parts) const {
        auto before = contents_of(folder_.path());
        expect_refusal(run(all), exit, "measure", parts);
        EXPECT_EQ(contents_of(folder_.path()), before);
    }
};

TEST_F(Measure, RefusesAMethodItDoesNotKnow) {
    expect_refused(words({"--method", "terain"}), 2,
                   {"--method terain", "did you mean terrain?", "known: terrain, lod-sprite, caveclod, discrete, wang-ldi, full"});
    expect_refused(words({"--method", "terrain@error=2"}), 2, {"terrain has no setting error"});
    expect_refused(words({"--method", "terrain", "--sweep", "speed=1,2"}), 2, {"--sweep speed=1,2"});
    expect_refused(words({}), 2, {"--method"});
}

TEST_F(Measure, RefusesAWrongSizeAndTooManyFrames) {
    for (const char* size : {"64", "0x64", "64x", "x", "9000x64", "64x64x64", "-1x5"}) {
        Words all = {"measure", baked_, "--flight", flight_, "--method", "full", "--size", size, "--out", folder_ / "out"};
        expect_refused(all, 2, {std::string("--size ") + size, "WIDTHxHEIGHT"});
    }
    expect_refused(words({"--method", "full", "--frames", "100001"}), 2, {"--frames 100001"});
}

TEST_F(Measure, WantsAFlightOrKeysAndNotBoth) {
    expect_refused({"measure", baked_, "--method", "full", "--out", folder_ / "out"}, 2, {"--flight", "--camera"});
    expect_refused(words({"--method", "full", "--camera", "0,0,0,0,0"}), 2, {"--flight", "--camera"});
}

TEST_F(Measure, RefusesABadScene) {
    std::string bad = folder_ / "bad.json";
    write_text(bad, R"({"version": 1, "layers": [{"asset": "a.ovl", "method": "terain"}]})");
    auto with_scene = [&](const std::string& scene) {
        return Words{"measure", scene, "--flight", flight_, "--method", "full", "--out", folder_ / "out"};
    };
    expect_refused(with_scene(bad), 3, {bad, "/layers/0/method", "did you mean terrain?"});
    expect_refused(with_scene(folder_ / "none.json"), 3, {"none.json", "No such file"});
    expect_refused(with_scene(folder_ / "none.ovl"), 3, {"none.ovl", "No such file"});
    expect_refused(with_scene(folder_ / "sample/dem.tif"), 3, {"dem.tif"});
    write_text(bad, R"({"version": 1, "layers": [{"asset": "a.ovl", "method": "terrain"}]})");
    expect_refused(with_scene(bad), 3, {"a.ovl", "No such file"});
    std::string layer = R"({"asset": ")" + baked_.substr(baked_.rfind('/') + 1) + R"(", "method": "terrain"})";
    write_text(bad, R"({"version": 1, "layers": [)" + layer + ", " + layer + "]}");
    expect_refused(with_scene(bad), 5, {bad, "there are 2 layers", "one terrain, one mesh or chains of levels"});
}

TEST_F(Measure, RefusesABadFlight) {
    write_text(flight_, R"({"version": 1, "interpolation": "linear", "step_s": 1, "keys": []})");
    expect_refused(words({"--method", "full"}), 3, {flight_, "/keys"});
}

TEST_F(Measure, RefusesAFolderThatCannotBeMade) {
    write_text(folder_ / "out", "a file");
    expect_refused(words({"--method", "full"}), 4, {folder_ / "out"});
}

TEST_F(Measure, LeavesTablesPicturesAndAPage) {
    Ran ran = run(words({"--method", "terrain", "--sweep", "error-px=1,16", "--json"}));
    if (ran.exit == 5) GTEST_SKIP() << "no renderer: " << ran.err;
    expect_done(ran);
    auto report = nlohmann::json::parse(ran.out);
    ASSERT_EQ(report["runs"].size(), 3u);
    EXPECT_EQ(report["runs"][1]["run"], "terrain@error-px=16@samples=4@morph=0.5");
    EXPECT_EQ(report["runs"][2]["run"], "full@samples=4");
    EXPECT_EQ(report["runs"][0]["frames"], 4);
    EXPECT_EQ(report["step_s"], 0.5);
    EXPECT_EQ(text_of_file(folder_ / "out/runs.json"), ran.out);
    for (const char* name : {"frames.csv", "runs.csv", "index.html", "charts/front_ms.gp"}) {
        EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("out/") + name))) << name;
    }
}

TEST_F(Measure, ByTheWallClockLeavesAPageToo) {
    Ran ran = run(words({"--method", "terrain", "--wall-clock", "--quiet"}));
    if (ran.exit == 5) GTEST_SKIP() << "no renderer: " << ran.err;
    expect_done(ran);
    EXPECT_EQ(ran.err, "");
    EXPECT_NE(text_of_file(folder_ / "out/index.html").find("wall clock"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/cache"));
}

TEST_F(Measure, WithoutNumbersDrawsNoReferenceAndNoFloor) {
    Ran ran = run(words({"--method", "terrain", "--numbers", "none", "--json"}));
    if (ran.exit == 5) GTEST_SKIP() << "no renderer: " << ran.err;
    expect_done(ran);
    auto report = nlohmann::json::parse(ran.out);
    EXPECT_EQ(report["runs"].size(), 1u);
    EXPECT_EQ(report["clock"], "logical");
    EXPECT_EQ(report["references"]["drawn"], 0);
    EXPECT_FALSE(report["runs"][0]["summary"].contains("e_p99_flip"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/cache"));
    expect_refused(words({"--method", "terrain", "--numbers", "some"}), 2, {"--numbers", "some"});
}

TEST_F(Measure, TakesKeysInPlaceOfAFlight) {
    Ran ran = run({"measure", baked_, "--camera", "300,-1500,900,0,-30", "--camera", "330,-1480,900,2,-30", "--frames", "4",
                   "--size", "64x64", "--method", "full@samples=1", "--out", folder_ / "out"});
    if (ran.exit == 5) GTEST_SKIP() << "no renderer: " << ran.err;
    expect_done(ran);
    std::string csv = text_of_file(folder_ / "out/frames.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
}

}  // namespace
}  // namespace overlook::cli
