#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/player/controls.h"
#include "runtime/player/flight.h"
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
        player::fly(camera, flyer, input, 1.0 / 30, terrain);
        std::optional<double> ground = player::ground_m(terrain, camera.position_m.x, camera.position_m.y);
        if (!ground) continue;
        ASSERT_GE(camera.position_m.z, *ground + player::kLeastHeight_m) << "frame " << frame;
        touched = touched || camera.position_m.z < *ground + player::kLeastHeight_m + 1;
    }
    EXPECT_TRUE(touched);
}

TEST(Flight, TurnsTheShorterWayRound) {
    view::Camera a, b;
    a.heading_deg = 350;
    b.heading_deg = 20;
    b.position_m = {10, 20, 30};
    EXPECT_NEAR(std::remainder(player::camera_at({a, b}, 0.5).heading_deg - 5, 360.0), 0, 1e-9);
    EXPECT_NEAR(player::camera_at({a, b}, 0.5).position_m.y, 10, 1e-9);
    EXPECT_EQ(player::camera_at({a, b}, 1).position_m, b.position_m);
}

}  // namespace
}  // namespace overlook
