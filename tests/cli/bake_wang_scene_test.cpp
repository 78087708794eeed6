// bake-wang-ldi --only scene: one image of a whole ground, the same bytes whatever threads; one line for options that make no
// sense.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

using Words = std::vector<std::string>;

class BakeWangScene : public testing::Test {
  protected:
    ScratchFolder folder_;

    void SetUp() override {
        write_text(folder_ / "post.obj", "v -0.2 0 0\nv 0.2 0 0\nv 0 0 1\nv 0 -0.2 0\nv 0 0.2 0\nv 0 0 0.7\nf 1 2 3\nf 4 5 6\n");
        write_text(folder_ / "posts.toml",
                   "tile_size_m = 3\n\n[[model]]\nfile = \"post.obj\"\npacking_radius_m = 0.3\ntight_radius_m = 0.26\n");
    }
    Ran bake(const std::string& output, const Words& more) {
        Words words{"bake-wang-ldi",
                    folder_ / "posts.toml",
                    "-o",
                    folder_ / output,
                    "--tiles",
                    "8",
                    "--sky-rays",
                    "4",
                    "--sun-rays",
                    "2"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
};

// Of six tiles a side from five eyes.
Words small_and(const Words& more) {
    Words words{"--only", "scene", "--scene-tiles", "6", "--scene-size", "64x48", "--scene-eyes", "5"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST_F(BakeWangScene, IsOneImageAndPicturesTheSameBytesWhateverThreads) {
    Ran ran = bake("a.ovl", small_and({"--json", "--threads", "1"}));
    expect_done(ran);
    nlohmann::json report = nlohmann::json::parse(ran.out)["scene"];
    EXPECT_EQ(report["tiles_a_side"], 6);
    EXPECT_EQ(report["pictures"], 13);
    EXPECT_EQ(report["rays"], 5 * 64 * 48);
    EXPECT_GT(report["samples"], 300);
    EXPECT_GT(report["bytes"], 300);
    EXPECT_GE(report["most_layers"], 2);
    expect_done(bake("b.ovl", small_and({})));
    EXPECT_TRUE(text_of_file(folder_ / "a.ovl") == text_of_file(folder_ / "b.ovl"));
    Ran told = run({"baked", "info", folder_ / "a.ovl", "--json"});
    expect_done(told);
    nlohmann::json scene = nlohmann::json::parse(told.out)["scene"];
    EXPECT_EQ(scene["columns"], 6);
    EXPECT_EQ(scene["rows"], 6);
    EXPECT_EQ(scene["width_px"], 64);
    EXPECT_EQ(scene["height_px"], 48);
    EXPECT_EQ(scene["pictures"], 13);
    for (const char* same : {"samples", "most_layers", "far_m"}) EXPECT_EQ(scene[same], report[same]) << same;
    EXPECT_EQ(scene["stored_bytes"], report["bytes"]);
    EXPECT_GT(scene["pixels_with_samples"], 100);
    Ran said = run({"baked", "info", folder_ / "a.ovl"});
    expect_done(said);
    EXPECT_NE(said.out.find("scene: 6 x 6 tiles as one image of 64 x 48 px, lit: "), std::string::npos) << said.out;
    EXPECT_NE(said.out.find("; 13 pictures by rays\n"), std::string::npos) << said.out;
    Ran proof = run({"baked", "verify", folder_ / "a.ovl", "--json"});
    expect_done(proof);
    EXPECT_EQ(nlohmann::json::parse(proof.out)["scene_pictures"], 14);
}

TEST_F(BakeWangScene, IsOfTheCameraAndDepthsAsked) {
    Ran all =
        bake("c.ovl", small_and({"--json", "--scene-layers", "all", "--light", "later", "--scene-camera", "1,2,1.5,450,-10,50",
                                 "--scene-near-m", "0.5", "--scene-far-m", "6", "--scene-views", "0"}));
    expect_done(all);
    nlohmann::json of_all = nlohmann::json::parse(all.out)["scene"];
    EXPECT_EQ(of_all["pictures"], 1);
    EXPECT_EQ(of_all["far_m"], 6);
    EXPECT_EQ(of_all["rays"], 64 * 48);
}

TEST_F(BakeWangScene, RefusesWhatMakesNoSenseInALine) {
    auto before = contents_of(folder_.path());
    struct Bad {
        Words words;
        std::string part;
    };
    for (const Bad& bad :
         {Bad{{"--scene-size", "64"}, "--scene-size 64: WIDTHxHEIGHT is wanted"},
          Bad{{"--scene-size", "0x48"}, "--scene-size 0x48"}, Bad{{"--scene-size", "64x4097"}, "--scene-size 64x4097"},
          Bad{{"--scene-camera", "1,2"}, "--scene-camera 1,2: x,y,z,heading,pitch[,fov_y] are wanted"},
          Bad{{"--scene-camera", "99,0,1,0,0"}, "the eye stands outside of the ground, which is 120 m wide"},
          Bad{{"--scene-camera", "0,0,1e7,0,0"}, "--scene-camera 0,0,1e7,0,0: an eye at (0, 0, 10000000) m"},
          Bad{{"--scene-far-m", "0.05"}, "--scene-far-m 0.05: is not beyond --scene-near-m 0.1"},
          Bad{{"--scene-near-m", "0"}, "--scene-near-m"}, Bad{{"--scene-eyes", "0"}, "--scene-eyes"},
          Bad{{"--scene-tiles", "1"}, "--scene-tiles"}, Bad{{"--scene-cell-m", "-1"}, "--scene-cell-m"},
          Bad{{"--scene-cell-m", "nan"}, "--scene-cell-m"}, Bad{{"--scene-merge", "2"}, "--scene-merge"},
          Bad{{"--scene-layers", "some"}, "--scene-layers"}, Bad{{"--scene-views", "65"}, "--scene-views"}}) {
        Words words{"--only", "scene"};
        words.insert(words.end(), bad.words.begin(), bad.words.end());
        expect_refusal(bake("a.ovl", words), 2, "bake-wang-ldi", {bad.part});
    }
    expect_refusal(bake("a.ovl", {"--only", "scene", "--scene-size", "4096x4096", "--scene-views", "64"}), 5, "bake-wang-ldi",
                   {"--scene-size 4096x4096: 385 pictures take", "more than 2^28"});
    expect_refusal(bake("a.ovl", {"--scene-eyes", "3"}), 2, "bake-wang-ldi", {"--scene-eyes: goes with --only scene"});
    expect_refusal(bake("a.ovl", {"--only", "scenes"}), 2, "bake-wang-ldi", {"--only"});
    EXPECT_EQ(contents_of(folder_.path()), before);
}

}  // namespace
}  // namespace overlook::cli
