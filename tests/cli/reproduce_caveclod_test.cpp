// reproduce caveclod as a program: a whole tiny run over hills, and what it refuses.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

using Words = std::vector<std::string>;

// side x side squares of a metre over hills.
std::string hills_obj(uint32_t side) {
    std::string text;
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            text += fmt::format("v {} {} {:.4f}\n", x, y, 2 * std::sin(0.7 * x) * std::cos(0.5 * y));
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            uint32_t at = y * (side + 1) + x + 1;
            text += fmt::format("f {} {} {} {}\n", at, at + 1, at + side + 2, at + side + 1);
        }
    return text;
}

std::string flight(double x_m, double step_s) {
    return fmt::format(R"({{"version": 1, "step_s": {}, "interpolation": "linear", "keys": [
      {{"time_s": 0, "position_m": [{}, 2, 4], "heading_deg": 0, "pitch_deg": -15}},
      {{"time_s": 2, "position_m": [{}, 12, 4], "heading_deg": 30, "pitch_deg": -15}}]}})",
                       step_s, x_m, x_m);
}

class ReproduceCaveclod : public testing::Test {
  protected:
    ScratchFolder folder_;
    std::string hills_ = folder_ / "hills";

    void SetUp() override {
        std::filesystem::create_directories(hills_);
        write_text(hills_ + "/hills.obj", hills_obj(20));
        write_text(hills_ + "/scene.json",
                   R"({"version": 1, "layers": [{"asset": "hills.ovl", "method": "caveclod"}], "error_px": 1})");
        for (char camera : {'a', 'b', 'c', 'd'})
            write_text(fmt::format("{}/flight-{}.json", hills_, camera), flight(4.0 + 3 * (camera - 'a'), 0.05));
        expect_done(run({"bake-lod", "mesh", hills_ + "/hills.obj", "-o", hills_ + "/hills.ovl", "--quiet"}));
        std::filesystem::copy_file(hills_ + "/hills.ovl", hills_ + "/classes.ovl");
    }
    Words words() const {
        return {"reproduce", "caveclod", hills_, "--out", folder_ / "out", "--frames", "8", "--size", "64x48"};
    }
};

TEST_F(ReproduceCaveclod, LeavesThePapersFiguresAndAPage) {
    Ran ran = run(words());
    expect_done(ran);
    EXPECT_NE(ran.err.find("times fewer than shared"), std::string::npos) << ran.err;
    for (const char* name : {"index.html", "windows.csv", "flyovers.csv", "memory.csv", "frame_rates.csv", "table1.csv",
                             "charts/figure-10.gp", "charts/figure-14.gp", "images/figure-5.png", "images/figure-8.png"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("out/") + name))) << name;
    std::string flyovers = text_of_file(folder_ / "out/flyovers.csv");
    for (const char* row : {"hills,caveclod,4,20,8,", "hills,caveclod:paper,3,", "hills,caveclod:shared,2,",
                            "hills,caveclod:paper at 7 %,1,", "hills,caveclod:shared,4,5,2,"})
        EXPECT_NE(flyovers.find(row), std::string::npos) << row << "\n" << flyovers;
    Words again = words();
    again[4] = folder_ / "again";
    expect_done(run(again));
    for (const char* counted : {"flyovers.csv", "windows.csv", "memory.csv", "table1.csv"})
        EXPECT_EQ(text_of_file(folder_ / (std::string("again/") + counted)), text_of_file(folder_ / (std::string("out/") + counted)))
            << counted;
}

TEST_F(ReproduceCaveclod, RefusesWhatItCannotFly) {
    Words twice = words();
    twice.insert(twice.begin() + 3, hills_ + "/");
    expect_refusal(run(twice), 2, "reproduce caveclod", {"another folder is called hills too"});
    Words tiny = words();
    tiny.back() = "64x1";
    expect_refusal(run(tiny), 2, "reproduce caveclod", {"--size 64x1"});
    write_text(hills_ + "/flight-c.json", flight(4, 0.1));
    expect_refusal(run(words()), 5, "reproduce caveclod", {"flight-c.json", "steps of 0.1 s"});
    std::filesystem::remove(hills_ + "/flight-b.json");
    expect_refusal(run(words()), 3, "reproduce caveclod", {"flight-b.json"});
    std::filesystem::remove(hills_ + "/hills.ovl");
    expect_refusal(run(words()), 3, "reproduce caveclod", {"hills.ovl"});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace overlook::cli
