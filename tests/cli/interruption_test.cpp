// A bake that is ended from outside, at the worst moment: while its file is being written.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

using Names = std::set<std::string>;

class Interruption : public testing::TestWithParam<int> {};

bool has_unfinished_file(const ScratchFolder& folder) {
    for (const std::string& name : folder.names())
        if (name.size() > 4 && name.substr(name.size() - 4) == ".tmp") return true;
    return false;
}

// Waits for the unfinished file and stops the bake there; false if it was too fast.
bool stop_while_writing(const ScratchFolder& folder, Running& bake) {
    auto begin = std::chrono::steady_clock::now();
    while (!has_unfinished_file(folder)) {
        if (std::chrono::steady_clock::now() - begin > std::chrono::seconds(60)) return false;
        if (text_of_file(folder / "out.ovl") != "an older file") return false;
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return bake.stop() && has_unfinished_file(folder);
}

// Hills of 2 * side * side triangles.
std::string hilly_obj(uint32_t side) {
    std::string text;
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            text += fmt::format("v {} {} {}\n", x, y, 4 * std::sin(0.2 * x) * std::cos(0.17 * y));
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            uint32_t a = y * (side + 1) + x + 1;
            text += fmt::format("f {} {} {} {}\n", a, a + 1, a + side + 2, a + side + 1);
        }
    return text;
}

void interrupt_while_writing(const ScratchFolder& folder, const std::string& source, const std::vector<std::string>& words,
                             int signal) {
    bool was_stopped = false;
    for (int attempt = 0; attempt < 5 && !was_stopped; ++attempt) {
        write_text(folder / "out.ovl", "an older file");
        Running bake(words);
        was_stopped = stop_while_writing(folder, bake);
        if (!was_stopped) continue;
        bake.send(signal);
        bake.send(SIGCONT);
        Ran ran = bake.wait();
        EXPECT_EQ(ran.signal, signal) << ran.err;
        EXPECT_EQ(ran.out + ran.err, "");
    }
    ASSERT_TRUE(was_stopped) << "the bake was never seen while it wrote";

    EXPECT_EQ(text_of_file(folder / "out.ovl"), "an older file");
    EXPECT_EQ(has_unfinished_file(folder), signal == SIGKILL);
    if (signal != SIGKILL) {
        EXPECT_EQ(folder.names(), (Names{source, "out.ovl"}));
    }

    expect_done(run(words));  // what is left behind is in nobody's way
    EXPECT_EQ(run({"baked", "info", folder / "out.ovl"}).exit, 0);
}

TEST_P(Interruption, LeavesTheOldFileAndNoHalfOfANewOne) {
    ScratchFolder folder;
    write_hgt(folder / "N10E010.hgt", 1201, hilly_m);
    interrupt_while_writing(folder, "N10E010.hgt",
                            {"bake-lod", "terrain", folder / "N10E010.hgt", "-o", folder / "out.ovl", "--no-texture"},
                            GetParam());
}

TEST_P(Interruption, OfAMeshLeavesTheOldFileAndNoHalfOfANewOne) {
    ScratchFolder folder;
    write_text(folder / "hills.obj", hilly_obj(120));
    interrupt_while_writing(folder, "hills.obj", {"bake-lod", "mesh", folder / "hills.obj", "-o", folder / "out.ovl", "--quiet"},
                            GetParam());
}

INSTANTIATE_TEST_SUITE_P(By, Interruption, testing::Values(SIGINT, SIGTERM, SIGKILL), [](const auto& by) {
    return by.param == SIGINT ? "SIGINT" : by.param == SIGTERM ? "SIGTERM" : "SIGKILL";
});

}  // namespace
}  // namespace overlook::cli
