// The player by LOD-sprite: what it reports, takes from a scene, and refuses.
#include "tests/gl/player_fixture.h"

namespace overlook {
namespace {

using test::kPlayer;
using test::Player;

constexpr const char* kSouthToNorth =
    " --headless --size 96x64 --frames 24 --camera 320,-900,300,0,-15 --camera 320,-700,300,10,-15";

TEST_F(Player, DrawsByLodSpriteAndReportsItsKeyframes) {
    std::string picture = " --samples 1 --report " + in_folder("report.json") + " --image ";
    ASSERT_EQ(play(file_ + kSouthToNorth + picture + in_folder("terrain.png")), 0) << output_;
    EXPECT_EQ(report()["method"], "terrain");
    EXPECT_FALSE(report().contains("keyframes"));
    EXPECT_EQ(output_.find("keyframe"), std::string::npos) << output_;
    for (std::string method : {"lod-sprite", "lod-sprite:paper"}) {
        std::string image = method == "lod-sprite" ? "sprite.png" : "paper.png";
        ASSERT_EQ(play(file_ + kSouthToNorth + picture + in_folder(image) + " --method " + method), 0) << output_;
        nlohmann::json json = report();
        EXPECT_EQ(json["method"], method);
        EXPECT_NE(bytes(image), bytes("terrain.png"));
        uint64_t keyframes = 0, key_triangles = 0, causes = 0;
        for (const auto& frame : json["frames"]) {
            keyframes += frame["rekeyed"] != "none";
            key_triangles += frame["key_triangles"].get<uint64_t>();
            EXPECT_LE(frame["key_triangles"], frame["triangles"]);
        }
        for (const auto& count : json["keyframes"]["causes"]) causes += count.get<uint64_t>();
        EXPECT_GE(keyframes, 1u);
        EXPECT_EQ(json["keyframes"]["count"], keyframes);
        EXPECT_EQ(json["keyframes"]["triangles"], key_triangles);
        EXPECT_EQ(json["keyframes"]["causes"]["first"], 1);
        EXPECT_EQ(causes, keyframes);
        std::string said = std::to_string(keyframes) + " keyframe" + (keyframes == 1 ? " of " : "s of ");
        EXPECT_NE(output_.find(said), std::string::npos) << output_;
        EXPECT_NE(output_.find("1 first"), std::string::npos) << output_;
    }
}

TEST_F(Player, TakesMethodAndSettingsFromTheScene) {
    write("scene.json", R"({"version":1,"error_px":2,"layers":[{"asset":"hills.ovl","method":"lod-sprite",
        "settings":{"low_error_px":8,"key_scale":1,"keyframe":"at-once"}}]})");
    std::string options = kSouthToNorth + (" --report " + in_folder("report.json"));
    ASSERT_EQ(play(in_folder("scene.json") + options), 0) << output_;
    nlohmann::json coarse = report();
    EXPECT_EQ(coarse["method"], "lod-sprite");
    EXPECT_EQ(coarse["error_px"], 2);
    EXPECT_EQ(coarse["frames"][0]["rekeyed"], "first");  // at once
    uint64_t texels = coarse["frames"][0]["key_pixels"];
    EXPECT_GT(texels, 96u * 64u);
    EXPECT_LT(texels, 2 * 96u * 64u);  // one a pixel, with the guard band

    // The command line goes before the scene; what the scene promises elsewhere keeps its ratio to the error.
    ASSERT_EQ(play(in_folder("scene.json") + options + " --error-px 0.25"), 0) << output_;
    EXPECT_GT(report()["summary"]["triangles"]["p50"], coarse["summary"]["triangles"]["p50"]);
    ASSERT_EQ(play(in_folder("scene.json") + options + " --method terrain"), 0) << output_;
    EXPECT_EQ(report()["method"], "terrain");
}

TEST_F(Player, RefusesWhatAMethodCannotDo) {
    for (std::string option : {"--triangles", "--frame-ms", "--morph", "--wireframe", "--split-picture"}) {
        bool has_value = option == "--triangles" || option == "--frame-ms" || option == "--morph";
        std::string whole = option + (has_value ? " 1" : "");
        for (std::string method : {"lod-sprite", "lod-sprite:paper"}) {
            std::string says = "player: " + option + ": " + method + " does not take it; --method terrain does\n";
            EXPECT_EQ(play(file_ + " --headless --method " + method + " " + whole), 2);
            EXPECT_EQ(output_, says);
            write("scene.json", R"({"version":1,"layers":[{"asset":"hills.ovl","method":")" + method + R"("}]})");
            EXPECT_EQ(play(in_folder("scene.json") + " --headless " + whole), 2);
            EXPECT_EQ(output_, says);
            EXPECT_EQ(play(in_folder("scene.json") + " --headless --size 16x16 --method terrain " + whole), 0) << output_;
        }
    }
    EXPECT_EQ(play(file_ + " --headless --method lod-sprit"), 2);
    EXPECT_EQ(output_,
              "player: --method lod-sprit: there is no such method; did you mean lod-sprite? (known: terrain, lod-sprite, "
              "lod-sprite:paper, caveclod, caveclod:paper, caveclod:shared, discrete, discrete:fsi, discrete:fsi-paper, "
              "discrete:switch, "
              "discrete:blend, discrete:dither, discrete:late, wang-ldi, wang-ldi:paper)\n");
}

TEST_F(Player, DrawsLodSpriteInAWindowAsWithoutOne) {
    OVERLOOK_NEEDS_A_DISPLAY();
    std::string flown = file_ +
                        " --method lod-sprite --samples 1 --size 160x120 --frames 24 --camera 320,-900,300,0,-15 "
                        "--camera 320,-700,300,10,-15 --image ";
    ASSERT_EQ(run("xvfb-run -a " + kPlayer + " " + flown + in_folder("window.png")), 0) << output_;
    ASSERT_EQ(play(flown + in_folder("headless.png") + " --headless"), 0) << output_;
    EXPECT_EQ(bytes("window.png"), bytes("headless.png"));
}

}  // namespace
}  // namespace overlook
