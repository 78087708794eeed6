// The player of terrains by its command line: in a window, without one, and over scenes.
#include "tests/gl/player_fixture.h"

namespace overlook {
namespace {

using test::kPlayer;
using test::Player;

TEST_F(Player, OpensAWindowAndEndsAfterTheFramesAskedFor) {
    OVERLOOK_NEEDS_A_DISPLAY();
    int status = run("xvfb-run -a " + kPlayer + " " + file_ + " --frames 3 --size 320x200 --report " + in_folder("report.json"));
    ASSERT_EQ(status, 0) << output_;
    EXPECT_EQ(report()["frames"].size(), 3u);
    EXPECT_GT(report()["frames"][2]["triangles"].get<int>(), 0);
}

TEST_F(Player, WritesNumberedPicturesAndAReport) {
    ASSERT_EQ(
        play(file_ + " --headless --size 64x48 --frames 2 --camera 320,-900,300,0,-15 --camera 320,-500,300,20,-15 --image " +
             in_folder("f%03d.png") + " --report " + in_folder("report.json")),
        0)
        << output_;
    EXPECT_TRUE(std::filesystem::exists(in_folder("f000.png")) && std::filesystem::exists(in_folder("f001.png")));
    nlohmann::json json = report();
    EXPECT_TRUE(json["renderer"]["software"].get<bool>());
    EXPECT_EQ(json["width_px"], 64);
    for (const auto& frame : json["frames"]) EXPECT_LE(frame["predicted_error_px"].get<double>(), json["error_px"].get<double>());
    EXPECT_GE(json["summary"]["triangles"]["max"].get<double>(), json["summary"]["triangles"]["p50"].get<double>());
}

TEST_F(Player, SaysInOneLineThatThereIsNoDisplay) {
    EXPECT_EQ(play(file_), 5) << output_;
    EXPECT_TRUE(is_one_line()) << output_;
    EXPECT_NE(output_.find("--headless"), std::string::npos) << output_;
}

TEST_F(Player, RefusesCommandLinesThatMakeNoSense) {
    for (const char* wrong : {"--size 0x5",
                              "--size 640",
                              "--size 640x",
                              "--size -4x4",
                              "--size 99999x4",
                              "--error-px 0",
                              "--error-px -1",
                              "--error-px nan",
                              "--error-px inf",
                              "--error-px x",
                              "--camera 1,2,3",
                              "--camera 1,2,nan,0,0",
                              "--camera 1,2,3,0,91",
                              "--camera 1e300,2,3,0,0",
                              "--haze -1",
                              "--samples 3",
                              "--wireframe --split-picture",
                              "--image a%s.png",
                              "--image %d%d.png",
                              "--frames -2",
                              "--colour"}) {
        EXPECT_EQ(play(file_ + " --headless " + wrong), 2) << wrong << ": " << output_;
        EXPECT_TRUE(is_one_line()) << wrong << ": " << output_;
    }
}

TEST_F(Player, RefusesMissingAndDamagedFiles) {
    EXPECT_EQ(play(in_folder("none.ovl") + " --headless"), 3);
    EXPECT_TRUE(is_one_line()) << output_;
    std::filesystem::resize_file(file_, std::filesystem::file_size(file_) / 2);
    EXPECT_EQ(play(file_ + " --headless"), 3);
    EXPECT_TRUE(is_one_line()) << output_;
}

TEST_F(Player, SaysWhenAPictureCannotBeWritten) {
    EXPECT_EQ(play(file_ + " --headless --size 16x16 --quiet --image " + in_folder("no_such_folder/a.png")), 4);
    EXPECT_TRUE(is_one_line()) << output_;
    EXPECT_EQ(play(file_ + " --headless --size 16x16 --quiet --report " + in_folder("no_such_folder/a.json")), 4);
    EXPECT_TRUE(is_one_line()) << output_;
}

TEST_F(Player, FollowsAFlightOverAScene) {
    write("scene.json", R"({"version":1,"layers":[{"asset":"hills.ovl","method":"terrain",
        "transform":{"translation_m":[1e6,2e6,100],"rotation_z_deg":0,"scale":2}}],"error_px":3})");
    write("flight.json", R"({"version":1,"step_s":0.5,"interpolation":"linear","keys":[
        {"time_s":0,"position_m":[1000640,1998200,700],"heading_deg":0,"pitch_deg":-15},
        {"time_s":1,"position_m":[1000640,1999000,700],"heading_deg":20,"pitch_deg":-15}]})");
    std::string options = " --headless --size 64x48 --report " + in_folder("report.json");
    ASSERT_EQ(
        play(in_folder("scene.json") + options + " --flight " + in_folder("flight.json") + " --image " + in_folder("s%d.png")), 0)
        << output_;
    ASSERT_EQ(report()["frames"].size(), 3u);
    EXPECT_EQ(report()["error_px"], 3);
    // The same by itself: moved, and half as large.
    ASSERT_EQ(
        play(file_ + options + " --error-px 3 --frames 3 --camera 320,-900,300,0,-15 --camera 320,-500,300,20,-15 --image " +
             in_folder("o%d.png")),
        0)
        << output_;
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_EQ(bytes("s" + std::to_string(frame) + ".png"), bytes("o" + std::to_string(frame) + ".png")) << frame;
    EXPECT_NE(bytes("s0.png"), bytes("s2.png"));

    ASSERT_EQ(play(in_folder("scene.json") + options + " --error-px 1 --frames 2 --flight " + in_folder("flight.json")), 0);
    EXPECT_EQ(report()["frames"].size(), 2u);
    EXPECT_EQ(report()["error_px"], 1);
}

TEST_F(Player, RefusesScenesThatItCannotDraw) {
    struct Case {
        std::string layers;
        int exit;
        std::string message;
    };
    for (const Case& c : std::initializer_list<Case>{
             {R"({"asset":"hills.ovl","method":"terrain"},{"asset":"hills.ovl","method":"terrain"})", 5,
              "/layers/0: " + folder_.string() +
                  "/hills.ovl is a terrain; of scenes of several layers the player draws chains of "
                  "levels alone\n"},
             {R"({"asset":"hills.ovl","method":"wang-ldi"})", 3, "hills.ovl is a terrain\n"},
             {R"({"asset":"hills.ovl","method":"caveclod"})", 3, "hills.ovl is a terrain\n"},
             {R"({"asset":"hills.ovl","method":"lod-sprite:papr"})", 3,
              "scene.json: /layers/0/method: lod-sprite has no variant papr\n"},
             {R"({"asset":"hills.ovl","method":"lod-sprite","settings":{"low_eror_px":4}})", 3,
              "scene.json: /layers/0/settings/low_eror_px: lod-sprite has no such setting; did you mean low_error_px?\n"},
             {R"({"asset":"hills.ovl","method":"lod-sprite:paper","settings":{"strip":true}})", 3,
              "/layers/0/settings/strip: lod-sprite:paper has no such setting; did you mean strips?\n"},
             {R"({"asset":"hills.ovl","method":"lod-sprite","settings":{"key_scale":1.5}})", 3,
              "scene.json: /layers/0/settings/key_scale: a whole number from 1 to 4 is wanted\n"},
             {R"({"asset":"hills.ovl","method":"lod-sprite","settings":{"near":1}})", 3,
              "scene.json: /layers/0/settings/near: true or false is wanted\n"},
             {R"({"asset":"hills.ovl","method":"lod-sprite","settings":{"keyframe":"threads"}})", 3,
              "scene.json: /layers/0/settings/keyframe: at-once, thread or sliced is wanted\n"},
             {R"({"asset":"hills.ovl","method":"lod-sprite","settings":{"error_px":2,"low_error_px":1}})", 3,
              "scene.json: /layers/0/settings/low_error_px: 1 is less than the error_px of 2\n"},
             {R"({"asset":"hills.ovl","method":"terrain:paper"})", 3,
              "scene.json: /layers/0/method: terrain has no variant paper\n"},
             {R"({"asset":"hills.ovl","method":"terrain","settings":{"eror_px":1}})", 3,
              "scene.json: /layers/0/settings/eror_px: terrain has no such setting; did you mean error_px?\n"},
             {R"({"asset":"hills.ovl","method":"terrain","settings":{"error_px":true}})", 3,
              "scene.json: /layers/0/settings/error_px: a number from 0.001 to 10000 is wanted\n"},
             {R"({"asset":"none.ovl","method":"terrain"})", 3, "none.ovl: No such file or directory\n"}}) {
        write("scene.json", R"({"version":1,"layers":[)" + c.layers + "]}");
        EXPECT_EQ(play(in_folder("scene.json") + " --headless --size 16x16"), c.exit) << output_;
        EXPECT_TRUE(output_.ends_with(c.message)) << output_;
        EXPECT_TRUE(is_one_line()) << output_;
    }
    write("flight.json", "{\"version\":1,\n\"keys\":[],\"interpolation\":\"linear\"}");
    EXPECT_EQ(play(file_ + " --headless --flight " + in_folder("flight.json")), 3);
    EXPECT_TRUE(output_.ends_with("flight.json:2:8: /keys: has 0 items; 1 to 65536 are wanted\n")) << output_;
    EXPECT_EQ(play(file_ + " --headless --camera 1,2,3,0,0 --flight " + in_folder("flight.json")), 2) << output_;
}

}  // namespace
}  // namespace overlook
