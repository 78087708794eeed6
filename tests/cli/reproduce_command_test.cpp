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
        return {"reproduce", "lod-sprite", sample_, "--out",  folder_ / "out", "--method",
                method,      "--frames",   "16",    "--size", "32x32"};
    }
};

TEST_F(Reproduce, LeavesThePapersFiguresAndAPage) {
    Ran ran = run(words("terrain:hard"));
    expect_done(ran);
    EXPECT_NE(ran.err.find("speed-up of the mean frame"), std::string::npos) << ran.err;
    for (const char* name : {"index.html", "measured.html", "frames.csv", "runs.json", "thresholds.csv", "frame_counts.csv",
                             "path.csv", "map.csv", "charts/figure-9.gp", "images/figure-6a.png", "images/figure-7e.png"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("out/") + name))) << name;
    std::string counts = text_of_file(folder_ / "out/frame_counts.csv");
    for (const char* frames : {",2,", ",4,", ",8,", ",16,", ",32,"}) EXPECT_NE(counts.find(frames), std::string::npos) << counts;
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
