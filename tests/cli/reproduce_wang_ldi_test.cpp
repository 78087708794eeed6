// reproduce wang-ldi as a program: a whole run over few small bushes, and what it refuses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class ReproduceWangLdi : public testing::Test {
  protected:
    ScratchFolder folder_;
    std::string bushes_ = folder_ / "bushes";

    void SetUp() override {
        fs::create_directory(bushes_);
        std::string obj = "v 0 0 0.6\n";
        for (int i = 0; i < 16; ++i)
            obj += fmt::format("v {} {} {}\n", 0.25 * std::cos(0.3926990817 * i), 0.25 * std::sin(0.3926990817 * i),
                               i % 2 ? 0.0 : 0.1);
        for (int i = 0; i < 16; ++i) obj += fmt::format("f 1 {} {}\n", i + 2, (i + 1) % 16 + 2);
        write_text(bushes_ + "/bush.obj", obj);
        write_text(bushes_ + "/recipe.toml",
                   "tile_size_m = 3\n\n[[model]]\nfile = \"bush.obj\"\npacking_radius_m = 0.3\ntight_radius_m = 0.26\n");
        bake("paper", {"--tiles", "8", "--planting", "paper", "--judge", "1"});
        bake("single", {"--tiles", "1", "--planting", "paper"});
        bake("unlit", {"--tiles", "8", "--planting", "paper", "--light", "later"});
        bake("robinson", {"--tiles", "robinson", "--only", "planting"});
        bake("own", {"--tiles", "8"});
        scene("scene", {"--tiles", "8", "--planting", "paper", "--scene-eyes", "6"});
        scene("single-scene", {"--tiles", "1", "--planting", "paper", "--scene-eyes", "1"});
        scene("own-scene", {"--tiles", "8", "--scene-eyes", "1"});
        sheet("paper", "sheet"), sheet("own", "sheet-own");
    }
    void bake(const std::string& name, const Words& more) {
        Words words{"bake-wang-ldi",
                    bushes_ + "/recipe.toml",
                    "-o",
                    bushes_ + "/" + name + ".ovl",
                    "--height-px",
                    "120",
                    "--error-px",
                    "3",
                    "--sky-rays",
                    "4",
                    "--sun-rays",
                    "1",
                    "--direction-px",
                    "66",
                    "--textures",
                    "none",
                    "--farthest-m",
                    "16",
                    "--json"};
        words.insert(words.end(), more.begin(), more.end());
        Ran ran = run(words);
        expect_done(ran);
        write_text(bushes_ + "/" + name + ".json", ran.out);
    }
    void scene(const std::string& name, const Words& more) {
        Words words{"--only", "scene", "--scene-tiles", "8", "--scene-size", "64x48", "--scene-views", "1"};
        words.insert(words.end(), more.begin(), more.end());
        bake(name, words);
    }
    void sheet(const std::string& name, const std::string& to) {
        expect_done(run({"baked", "info", bushes_ + "/" + name + ".ovl", "--sheet", bushes_ + "/" + to}));
    }
    Words words() const { return {"reproduce", "wang-ldi", bushes_, "--out", folder_ / "out"}; }
    void expect_refused(int exit, const std::vector<std::string>& parts) {
        expect_refusal(run(words()), exit, "reproduce wang-ldi", parts);
        EXPECT_FALSE(fs::exists(folder_ / "out"));
    }
};

TEST_F(ReproduceWangLdi, LeavesThePapersFiguresAndAPage) {
    Ran ran = run(words());
    expect_done(ran);
    for (const char* part : {"bushes: greatest correlation of tiles over lags 2 to 10", "bushes: bytes a sample"})
        EXPECT_NE(ran.err.find(part), std::string::npos) << ran.err;
    for (const char* name : {"index.html",
                             "sets.csv",
                             "levels.csv",
                             "planting.csv",
                             "figure-2.csv",
                             "charts/density-bushes.gp",
                             "charts/away-e-bushes.gp",
                             "charts/away-holes-bushes.gp",
                             "images/figure-2a-rays-bushes.png",
                             "images/figure-2d-aside-bushes.png",
                             "images/figure-2a-bushes.png",
                             "images/figure-2b-bushes.png",
                             "images/figure-2c-bushes.png",
                             "images/figure-2d-bushes.png",
                             "images/figure-2-own-bushes.png",
                             "images/tiles-bushes.png",
                             "images/tiling-256-own-bushes.png",
                             "images/figure-7-bushes.png",
                             "images/figure-8-bushes.png",
                             "images/figure-9-bushes.png",
                             "images/figure-tiles-above-bushes.png",
                             "images/figure-tiles-aside-bushes.png"})
        EXPECT_TRUE(fs::exists(folder_ / (std::string("out/") + name))) << name;
    std::string sets = text_of_file(folder_ / "out/sets.csv"), levels = text_of_file(folder_ / "out/levels.csv");
    for (const char* row : {"bushes,paper,8,", "bushes,own,8,", "bushes,single,1,", "bushes,robinson,16,"})
        EXPECT_NE(sets.find(row), std::string::npos) << row << "\n" << sets;
    EXPECT_NE(levels.find("bushes,own,"), std::string::npos) << levels;
    // From its own place the one LDI is what rays see, to the last pixel: no error before holes are filled, none that order
    // makes.
    std::string figure = text_of_file(folder_ / "out/figure-2.csv");
    size_t own = figure.find("\nbushes,\"one LDI\",0,1,");
    ASSERT_NE(own, std::string::npos) << figure;
    std::string row = figure.substr(own + 1, figure.find('\n', own + 1) - own - 1);
    size_t from = row.find(",0,1,") + 5;
    for (int column = 0; column < 2; ++column) from = row.find(',', from) + 1;  // E filled, and its p99
    EXPECT_TRUE(row.substr(from).starts_with("0,0,0,0,0,0,")) << row;
    EXPECT_EQ(std::count(figure.begin(), figure.end(), '\n'), 1 + 4 * 7) << figure;
    std::string page = text_of_file(folder_ / "out/index.html");
    for (const char* part : {"Figures to reach", "Figure 2: bushes", "Figures 3 and 4", "Figures 5 and 6", "Figures 7 to 9"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    // Every picture of the page is there.
    for (size_t at = page.find("src=\"images/"); at != std::string::npos; at = page.find("src=\"images/", at + 1)) {
        std::string name = page.substr(at + 5, page.find('"', at + 5) - at - 5);
        EXPECT_TRUE(fs::exists(folder_ / ("out/" + name))) << name;
    }
}

TEST_F(ReproduceWangLdi, RefusesWhatDoesNotBelongTogetherOrIsNotThere) {
    Words twice = words();
    twice.insert(twice.begin() + 3, bushes_ + "/");
    expect_refusal(run(twice), 2, "reproduce wang-ldi", {"another folder is called bushes too"});
    std::string report = text_of_file(bushes_ + "/own.json");
    write_text(bushes_ + "/own.json", text_of_file(bushes_ + "/paper.json"));
    expect_refused(3, {"own.json", "is of another bake", "own.ovl"});
    write_text(bushes_ + "/own.json", "{\"tiles\": 3}");
    expect_refused(3, {"own.json", "is not what bake-wang-ldi --json says"});
    write_text(bushes_ + "/own.json", report);
    fs::rename(bushes_ + "/sheet-own/planting.png", bushes_ + "/away.png");
    expect_refused(3, {"sheet-own/planting.png"});
    write_text(bushes_ + "/sheet-own/planting.png", "no picture");
    expect_refused(3, {"sheet-own/planting.png", "is no picture"});
    std::string scene = text_of_file(bushes_ + "/scene.ovl");
    write_text(bushes_ + "/scene.ovl", text_of_file(bushes_ + "/single-scene.ovl"));
    expect_refused(3, {"scene.ovl", "is of other ground than", "paper.ovl"});
    write_text(bushes_ + "/scene.ovl", text_of_file(bushes_ + "/paper.ovl"));
    expect_refused(3, {"scene.ovl", "V1"});
    write_text(bushes_ + "/scene.ovl", scene);
    fs::copy_file(bushes_ + "/robinson.ovl", bushes_ + "/unlit.ovl", fs::copy_options::overwrite_existing);
    expect_refused(3, {"unlit.ovl", "L1"});
}

}  // namespace
}  // namespace overlook::cli
