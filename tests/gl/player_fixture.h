// Runs the player as a command, in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/caveclod.h"
#include "tests/caveclod/synthetic_hierarchy.h"
#include "tests/gl/fixture.h"

namespace overlook::test {

inline const std::string kPlayer = OVERLOOK_BINARY_DIR "/bin/player";

inline bool has_display() {
    return std::system("command -v xvfb-run >/dev/null 2>&1") == 0;
}

// A folder of its own with a baked terrain in it, gone at the end.
class Player : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("overlook_player_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
        file_ = (folder_ / "hills.ovl").string();
        auto writer = container::Writer::create(file_, terrain::kKind);
        ASSERT_TRUE(writer);
        ASSERT_TRUE(terrain::write(*writer, hilly_terrain(65)));
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

}  // namespace overlook::test

// Stops a test with a line that says why, where no window can be opened.
#define OVERLOOK_NEEDS_A_DISPLAY() \
    if (!test::has_display()) GTEST_SKIP() << "xvfb-run is not installed: no window was opened"
