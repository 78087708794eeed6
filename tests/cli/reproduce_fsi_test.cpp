// reproduce fsi as a program: a whole run over few spheres and cubes, and what it refuses.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

using Words = std::vector<std::string>;

class ReproduceFsi : public testing::Test {
  protected:
    ScratchFolder folder_;
    std::string simple_ = folder_ / "simple";

    void SetUp() override {
        expect_done(run({"make-sample", "simple", "-o", simple_, "--count", "9", "--quiet"}));
        expect_done(
            run({"bake-lod", "discrete", simple_ + "/plain.glb", "--most-levels", "1", "-o", simple_ + "/plain.ovl", "--quiet"}));
        bake("noise", "simple.ovl");
    }
    void bake(const std::string& visibility, const std::string& name) {
        expect_done(run({"bake-lod", "discrete", simple_ + "/simple-0.glb", simple_ + "/simple-1.glb", "--visibility", visibility,
                         "-o", simple_ + "/" + name, "--quiet"}));
    }
    Words words() const { return {"reproduce", "fsi", simple_, "--out", folder_ / "out", "--frames", "2"}; }
};

TEST_F(ReproduceFsi, LeavesThePapersFiguresAndAPage) {
    Ran ran = run(words());
    expect_done(ran);
    EXPECT_NE(ran.err.find("pop index (of the worst tile, over its levels at rest), entering or leaving a transition"),
              std::string::npos)
        << ran.err;
    for (const char* name :
         {"index.html", "sizes.csv", "films.csv", "ramps.csv", "charts/figure-2.gp", "charts/figure-8-simple.gp"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("out/") + name))) << name;
    std::string sizes = text_of_file(folder_ / "out/sizes.csv"), films = text_of_file(folder_ / "out/films.csv");
    for (const char* method : {"switch", "blend", "dither", "late", "fsi:paper", "fsi"})
        for (const char* side : {"256", "512", "1024"}) {
            std::string row = std::string("simple,,") + method + "," + side + ",2,";
            EXPECT_NE(sizes.find(row), std::string::npos) << row << "\n" << sizes;
            EXPECT_NE(films.find(std::string("simple,,") + method + ",1,0,"), std::string::npos) << films;
        }
    std::string page = text_of_file(folder_ / "out/index.html");
    for (const char* part : {"Figure 8", "SIMPLE", "Figures to reach", "Entering and leaving"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST_F(ReproduceFsi, RefusesWhatItCannotFly) {
    Words twice = words();
    twice.insert(twice.begin() + 3, simple_ + "/");
    expect_refusal(run(twice), 2, "reproduce fsi", {"another folder is called simple too"});
    Words none = words();
    none.back() = "1";
    expect_refusal(run(none), 2, "reproduce fsi", {"--frames"});
    std::filesystem::remove(simple_ + "/flight.json");
    expect_refusal(run(words()), 3, "reproduce fsi", {"flight.json"});
    write_text(simple_ + "/scene.json",
               R"({"version": 1, "layers": [{"asset": "plain.ovl", "method": "discrete"}], "error_px": 1})");
    expect_refusal(run(words()), 5, "reproduce fsi", {"holds no chain of several levels"});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace overlook::cli
