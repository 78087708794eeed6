// reproduce as a program: what it refuses, and a whole tiny run with the terrain standing in for a sprite.

#include <gtest/gtest.h>

#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

using Words = std::vector<std::string>;

class Reproduce : public testing::Test {
  protected:
    ScratchFolder folder_;
    std::string sample_ = folder_ / "sample";

    void SetUp() override {
        expect_done(run({"make-sample", "lod-sprite", "-o", sample_, "--size", "65", "--quiet"}));
        expect_done(run({"bake-lod", "terrain", sample_ + "/dem.tif", "--texture", sample_ + "/texture.ppm", "-o",
                         sample_ + "/sample.ovl", "--quiet"}));
    }
    Words words(const std::string& method) const {
        return {"reproduce", "lod-sprite", sample_,           "--out", folder_ / "out", "--method", method, "--frames", "16",
                "--size",    "32x32",      "--remedy-frames", "3",     "--held-keys",   "1"};
    }
};

TEST_F(Reproduce, LeavesThePapersFiguresAndAPage) {
    Ran ran = run(words("terrain:hard"));
    expect_done(ran);
    EXPECT_NE(ran.err.find("speed-up of the mean frame"), std::string::npos) << ran.err;
    for (const char* name : {"index.html", "measured.html", "frames.csv", "runs.json", "thresholds.csv", "frame_counts.csv",
                             "path.csv", "map.csv", "remedies.csv", "held_keys.csv", "charts/figure-9.gp",
                             "charts/losses-parallax.gp", "images/figure-6a.png", "images/figure-7e.png"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("out/") + name))) << name;
    std::string counts = text_of_file(folder_ / "out/frame_counts.csv");
    for (const char* frames : {",2,", ",4,", ",8,", ",16,", ",32,"}) EXPECT_NE(counts.find(frames), std::string::npos) << counts;
    std::string remedies = text_of_file(folder_ / "out/remedies.csv"), held = text_of_file(folder_ / "out/held_keys.csv");
    for (const char* off : {",slots=2,", ",guard=1,", ",fade-frames=0,", ",outlines=0,", ",place-test=0,", ",key-scale=1,"})
        EXPECT_NE(remedies.find(off), std::string::npos) << remedies;
    for (const char* range : {"\nlod-sprite,", "paper: depth thickness 1e-4,10,16,32,", "paper: 1e-4 in strips,10,64,,"})
        EXPECT_NE(held.find(range), std::string::npos) << held;
    std::string page = text_of_file(folder_ / "out/index.html");
    EXPECT_NE(page.find("What each remedy buys"), std::string::npos);
    EXPECT_NE(page.find("Ghosts and losses against parallax"), std::string::npos);
}

TEST_F(Reproduce, LeavesOutWhatIsNotAskedFor) {
    Words shorter = words("terrain:hard");
    for (size_t i = 0; i < shorter.size(); ++i)
        if (shorter[i] == "--remedy-frames" || shorter[i] == "--held-keys") shorter[i + 1] = "0";
    shorter.push_back("--no-sweeps");
    expect_done(run(shorter));
    std::string page = text_of_file(folder_ / "out/index.html");
    EXPECT_EQ(page.find("What each remedy buys"), std::string::npos);
    EXPECT_EQ(page.find("Ghosts and losses against parallax"), std::string::npos);
    EXPECT_EQ(page.find("figure-13"), std::string::npos);
    EXPECT_NE(page.find("figure-11"), std::string::npos);
}

TEST_F(Reproduce, RefusesWhatItCannotFly) {
    expect_refusal(run(words("terrain:none")), 2, "reproduce lod-sprite", {"--method terrain:none"});
    std::string text = text_of_file(sample_ + "/run.json");
    write_text(sample_ + "/run.json", text.substr(0, text.size() / 2));
    expect_refusal(run(words("terrain:hard")), 3, "reproduce lod-sprite", {"run.json"});
    std::filesystem::remove(sample_ + "/run.json");
    expect_refusal(run(words("terrain:hard")), 3, "reproduce lod-sprite", {"run.json", "No such file"});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace overlook::cli
