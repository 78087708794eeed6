#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "formats/caveclod.h"
#include "runtime/gl/png.h"
#include "runtime/player/controls.h"
#include "runtime/player/flight.h"
#include "runtime/player/record.h"
#include "runtime/player/scene.h"
#include "runtime/view/flight.h"
#include "tests/caveclod/synthetic_hierarchy.h"
#include "tests/gl/fixture.h"

namespace overlook {
namespace {

const std::string kPlayer = OVERLOOK_BINARY_DIR "/bin/player";

// A folder of its own with a baked terrain in it, gone at the end.
class Player : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("overlook_player_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
        file_ = (folder_ / "hills.ovl").string();
        auto writer = container::Writer::create(file_, terrain::kKind);
        ASSERT_TRUE(writer);
        ASSERT_TRUE(terrain::write(*writer, test::hilly_terrain(65)));
        ASSERT_TRUE(writer->commit());
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    // Runs a command line; the exit status, and both outputs together.
    int run(const std::string& command) {
        output_.clear();
        FILE* pipe = popen(("LIBGL_ALWAYS_SOFTWARE=1 " + command + " 2>&1").c_str(), "r");
        if (pipe == nullptr) return -1;
        char part[512];
        while (std::fgets(part, sizeof part, pipe) != nullptr) output_ += part;
        int status = pclose(pipe);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    int play(const std::string& options) { return run("env -u DISPLAY -u WAYLAND_DISPLAY " + kPlayer + " " + options); }
    bool is_one_line() const { return !output_.empty() && output_.find('\n') == output_.size() - 1; }
    std::string in_folder(const std::string& name) const { return (folder_ / name).string(); }
    nlohmann::json report() const { return nlohmann::json::parse(std::ifstream(in_folder("report.json"))); }

    void write(const std::string& name, const std::string& text) const { std::ofstream(in_folder(name)) << text; }
    std::string bytes(const std::string& name) const {
        std::ifstream in(in_folder(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    std::filesystem::path folder_;
    std::string file_, output_;
};

TEST_F(Player, OpensAWindowAndEndsAfterTheFramesAskedFor) {
    if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "xvfb-run is not installed: no window was opened";
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
              "scene.json: /layers/1: the player draws one thing at a time; leave one layer\n"},
             {R"({"asset":"hills.ovl","method":"wang-ldi"})", 5,
              "scene.json: /layers/0/method: the player cannot draw wang-ldi yet; it draws terrain, lod-sprite, caveclod and "
              "discrete\n"},
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
              "lod-sprite:paper, caveclod, caveclod:paper, caveclod:shared, discrete)\n");
}

TEST_F(Player, DrawsLodSpriteInAWindowAsWithoutOne) {
    if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "xvfb-run is not installed: no window was opened";
    std::string flown = file_ +
                        " --method lod-sprite --samples 1 --size 160x120 --frames 24 --camera 320,-900,300,0,-15 "
                        "--camera 320,-700,300,10,-15 --image ";
    ASSERT_EQ(run("xvfb-run -a " + kPlayer + " " + flown + in_folder("window.png")), 0) << output_;
    ASSERT_EQ(play(flown + in_folder("headless.png") + " --headless"), 0) << output_;
    EXPECT_EQ(bytes("window.png"), bytes("headless.png"));
}

// The same folder with a baked mesh in it.
class MeshPlayer : public Player {
  protected:
    void SetUp() override {
        Player::SetUp();
        mesh_ = in_folder("sphere.ovl");
        auto writer = container::Writer::create(mesh_, caveclod::kKind);
        ASSERT_TRUE(writer);
        ASSERT_TRUE(caveclod::write(*writer, caveclod::synthetic::bake(caveclod::synthetic::sphere(48))));
        ASSERT_TRUE(writer->add_provenance({"test", "0", {}, {}}));
        ASSERT_TRUE(writer->commit());
    }
    std::string flown(const std::string& method) const {
        return mesh_ + " --method " + method +
               " --samples 1 --size 160x120 --frames 12 --camera 0,-60,0,0,0 --camera 0,-30,5,4,-10 --report " +
               in_folder("report.json") + " --image ";
    }
    std::string mesh_;
};

TEST_F(MeshPlayer, DrawsItInEveryWayWithinTheErrorAsked) {
    for (const char* method : {"caveclod", "caveclod:paper", "caveclod:shared", "discrete"}) {
        SCOPED_TRACE(method);
        ASSERT_EQ(play(flown(method) + in_folder("sphere.png") + " --headless"), 0) << output_;
        nlohmann::json json = report();
        EXPECT_EQ(json["method"], method);
        ASSERT_EQ(json["frames"].size(), 12u);
        uint64_t operations = 0;
        for (const auto& frame : json["frames"]) {
            EXPECT_GT(frame["triangles"].get<int>(), 100);
            EXPECT_LE(frame["predicted_error_px"].get<double>(), 1);
            if (frame.contains("splits")) operations += frame["splits"].get<uint64_t>() + frame["collapses"].get<uint64_t>();
        }
        EXPECT_EQ(operations > 0, std::string(method) != "discrete");
    }
}

TEST_F(MeshPlayer, DrawsInAWindowAsWithoutOne) {
    if (std::system("command -v xvfb-run >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "xvfb-run is not installed: no window was opened";
    ASSERT_EQ(run("xvfb-run -a " + kPlayer + " " + flown("caveclod") + in_folder("window.png")), 0) << output_;
    ASSERT_EQ(play(flown("caveclod") + in_folder("headless.png") + " --headless"), 0) << output_;
    EXPECT_EQ(bytes("window.png"), bytes("headless.png"));
}

TEST_F(MeshPlayer, ShowsTheWholeMeshWhereNobodySaysWhereFrom) {
    ASSERT_EQ(play(mesh_ + " --headless --size 96x64 --image " + in_folder("whole.png")), 0) << output_;
    std::string png = bytes("whole.png");
    auto picture = decode_png("whole.png", std::as_bytes(std::span(png)));
    ASSERT_TRUE(picture);
    auto is_background = [&](uint32_t x, uint32_t y) {  // which is blue rather than grey
        const uint8_t* at = &picture->pixels[4 * (size_t(y) * picture->width + x)];
        return at[2] > at[0] + 8;
    };
    EXPECT_FALSE(is_background(48, 32));
    for (uint32_t x = 0; x < 96; ++x) EXPECT_TRUE(is_background(x, 0) && is_background(x, 63)) << x;
}

TEST_F(MeshPlayer, RefusesMethodsOfTheOtherKind) {
    EXPECT_EQ(play(mesh_ + " --method terrain --headless"), 2);
    EXPECT_EQ(output_, "player: --method terrain: it draws terrains, and " + mesh_ +
                           " holds a mesh; that takes caveclod, caveclod:paper, caveclod:shared, discrete\n");
    EXPECT_EQ(play(file_ + " --method discrete --headless"), 2);
    EXPECT_EQ(output_, "player: --method discrete: it draws meshes, and " + file_ +
                           " holds a terrain; that takes terrain, lod-sprite, lod-sprite:paper\n");
    EXPECT_EQ(play(mesh_ + " --morph 1 --headless"), 2);
    EXPECT_TRUE(is_one_line()) << output_;
    write("scene.json", R"({"version":1,"layers":[{"asset":"sphere.ovl","method":"lod-sprite"}]})");
    EXPECT_EQ(play(in_folder("scene.json") + " --headless"), 3);
    EXPECT_TRUE(is_one_line()) << output_;
    EXPECT_NE(output_.find("/layers/0/method: lod-sprite draws terrains"), std::string::npos) << output_;
}

TEST_F(MeshPlayer, KeepsABudgetOfTriangles) {
    ASSERT_EQ(play(flown("caveclod") + in_folder("few.png") + " --headless --error-px 0.05 --triangles 600"), 0) << output_;
    for (const auto& frame : report()["frames"]) {
        EXPECT_LE(frame["triangles"].get<int>(), 600);
        EXPECT_GT(frame["predicted_error_px"].get<double>(), 0.05);
    }
    ASSERT_EQ(play(flown("caveclod:paper") + in_folder("few.png") + " --headless --error-px 0.05 --triangles 600"), 0) << output_;
    EXPECT_GT(report()["frames"].back()["asked_error_px"].get<double>(), 0.05);  // by the error alone
}

TEST(PressedKeys, GoThroughTheMethodsOfMeshes) {
    player::FrameStyle style;
    style.method = player::Method::caveclod;
    player::Presses press;
    press.method = 1, press.toggles_wireframe = true;
    for (player::Method then :
         {player::Method::caveclod_paper, player::Method::caveclod_shared, player::Method::discrete, player::Method::caveclod}) {
        player::press(style, press);
        EXPECT_EQ(style.method, then);
    }
    EXPECT_EQ(style.look.look, terrain::Look::shaded);  // four times
}

TEST(PressedKeys, ChangeTheMethodAndWhatItShows) {
    player::FrameStyle style;
    player::Presses wireframe, sources, method;
    wireframe.toggles_wireframe = sources.toggles_sources = true;
    method.method = 1;
    player::press(style, sources);
    EXPECT_FALSE(style.shows_sources);  // terrain has none
    player::press(style, wireframe);
    EXPECT_EQ(style.look.look, terrain::Look::wireframe);
    player::press(style, method);
    EXPECT_EQ(style.method, player::Method::lod_sprite);
    player::press(style, sources);
    EXPECT_TRUE(style.shows_sources);
    player::press(style, wireframe);
    EXPECT_EQ(style.look.look, terrain::Look::wireframe);  // nothing of lod-sprite
    player::press(style, method);
    EXPECT_EQ(style.method, player::Method::lod_sprite_paper);
    player::press(style, method);
    EXPECT_EQ(style.method, player::Method::terrain);
}

TEST(WatchedKeys, TellWhenTheLastCameAndWhy) {
    using lod_sprite::Cause;
    player::KeyWatch keys;
    player::FrameRecord frame;
    frame.sprite.emplace();
    player::watch(keys, frame);
    EXPECT_EQ(keys.cause, Cause::none);
    frame.sprite->live_key_count = 1;
    frame.sprite->rekeyed = Cause::turned;
    player::watch(keys, frame);
    frame.sprite->rekeyed = Cause::none;
    for (int i = 0; i < 3; ++i) player::watch(keys, frame);
    EXPECT_EQ(keys.cause, Cause::turned);
    EXPECT_EQ(keys.frames_ago, 3u);
    player::watch(keys, {});  // by terrain
    EXPECT_EQ(keys.cause, Cause::none);
}

TEST(LodSpriteError, CarriesTheOtherPromisesAlong) {
    lod_sprite::FrameOptions options;
    lod_sprite::set(options, "low-error-px", 12);
    options = player::with_error(options, 2);
    EXPECT_EQ(options.decide.error_px, 2);
    EXPECT_EQ(options.decide.low_error_px, 24);
    EXPECT_EQ(options.decide.key_error_px, 2);
}

// A flight by hand, at an uneven frame rate: turns over north, stops, climbs.
std::vector<scene::Key> by_hand() {
    player::Recording recording{100, {}};
    view::Camera camera;
    for (int i = 0; i < 2000; ++i) {
        double t = i / 60.0 + 0.004 * (i % 3);
        camera.position_m = {300 * std::sin(t / 3), 40 * std::min(t, 12.0), 200 + std::max(0.0, t - 20) * 15};
        camera.heading_deg = 30 * std::sin(t / 2);
        camera.pitch_deg = -20 + 10 * std::cos(t);
        EXPECT_TRUE(player::add_sample(recording, camera, 100 + t));
        EXPECT_TRUE(player::add_sample(recording, camera, 100 + t));  // the same time again is left out
    }
    EXPECT_EQ(recording.samples.size(), 2000u);
    return recording.samples;
}

TEST(RecordedFlight, IsReproducedWithinItsToleranceByFewKeys) {
    std::vector<scene::Key> samples = by_hand();
    scene::Flight flight = player::thinned(samples, player::kRecordTolerance_m, player::kRecordTolerance_deg);
    EXPECT_LT(flight.keys.size(), samples.size() / 8);
    EXPECT_GT(flight.keys.size(), 8u);
    for (const scene::Key& sample : samples) {
        view::Camera camera = view::camera_at(flight, sample.time_s, {});
        const auto& [x, y, z] = sample.position_m;
        ASSERT_LE(glm::distance(camera.position_m, glm::dvec3(x, y, z)), player::kRecordTolerance_m) << sample.time_s;
        ASSERT_LE(std::abs(std::remainder(camera.heading_deg - sample.heading_deg, 360.0)), player::kRecordTolerance_deg);
        ASSERT_LE(std::abs(camera.pitch_deg - sample.pitch_deg), player::kRecordTolerance_deg);
    }
}

TEST(RecordedFlight, IsReadAgainAsItWasThinned) {
    player::Recording recording{0, by_hand()};
    std::string path = testing::TempDir() + "recorded.flight.json";
    Result<std::string> written = player::write_recording(recording, path);
    ASSERT_TRUE(written) << written.error().message;
    Result<scene::Flight> flight = scene::read_flight(path);
    ASSERT_TRUE(flight) << flight.error().message;
    EXPECT_EQ(
        scene::json_from_flight(*flight),
        scene::json_from_flight(player::thinned(recording.samples, player::kRecordTolerance_m, player::kRecordTolerance_deg)));
    recording.samples.resize(1);
    EXPECT_TRUE(player::write_recording(recording, path));
    EXPECT_EQ(scene::read_flight(path)->keys.size(), 1u);
    recording.samples[0].position_m[0] = 1e12;
    Result<std::string> refused = player::write_recording(recording, path);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().exit, Exit::impossible);
    std::filesystem::remove(path);
}

TEST(Flying, NeverGoesUnderTheGround) {
    terrain::Terrain terrain = test::hilly_terrain(65);
    view::Camera camera = test::from_south(terrain, 64, 48);
    camera.position_m = {100, -600, 400};
    player::Flyer flyer;
    player::Input input;
    input.up = -1;
    input.forward = 1;
    input.is_fast = true;
    bool touched = false;
    for (int frame = 0; frame < 600; ++frame) {
        player::fly(camera, flyer, input, 1.0 / 30, player::TerrainGround(terrain));
        std::optional<double> ground = player::ground_m(terrain, camera.position_m.x, camera.position_m.y);
        if (!ground) continue;
        ASSERT_GE(camera.position_m.z, *ground + player::kLeastHeight_m) << "frame " << frame;
        touched = touched || camera.position_m.z < *ground + player::kLeastHeight_m + 1;
    }
    EXPECT_TRUE(touched);
}

}  // namespace
}  // namespace overlook
