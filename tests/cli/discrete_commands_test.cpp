// Chains of levels through the commands: made, baked, looked at, proven, exported, and refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

nlohmann::json json_of(const Ran& ran) {
    return nlohmann::json::parse(ran.out);
}

TEST(DiscreteCommands, BakeLookProveAndExportAWindmill) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "windmills", "-o", folder.path(), "--count", "9"}));
    std::string mesh = folder / "windmill-1.glb", baked = folder / "windmill.ovl";
    Ran baking = run({"bake-lod", "discrete", mesh, "-o", baked, "--json"});
    expect_done(baking);
    nlohmann::json made = json_of(baking);
    EXPECT_EQ(made["levels_from"], "cut");
    EXPECT_EQ(made["parts"], 2);
    ASSERT_GE(made["levels"].size(), 4u);
    for (size_t k = 1; k < made["levels"].size(); ++k) {
        EXPECT_LE(made["levels"][k]["triangles"].get<double>() * 1.4, made["levels"][k - 1]["triangles"].get<double>());
        EXPECT_GT(made["levels"][k]["error_m"].get<double>(), made["levels"][k - 1]["error_m"].get<double>());
    }

    Ran looking = run({"baked", "info", baked, "--json"});
    expect_done(looking);
    EXPECT_EQ(json_of(looking)["kind"], "DISC");
    EXPECT_EQ(json_of(looking)["chain"]["levels"].size(), made["levels"].size());
    EXPECT_EQ(json_of(looking)["chain"]["parts"][1]["name"], "sails");
    expect_done(run({"baked", "info", baked}));

    Ran proving = run({"baked", "verify", baked, "--source", mesh, "--json"});
    expect_done(proving);
    EXPECT_EQ(json_of(proving)["holds"], true);

    Ran exporting = run({"baked", "export", baked, "--level", "1", "-o", folder / "level.ply", "--json"});
    expect_done(exporting);
    EXPECT_EQ(json_of(exporting)["triangles"], made["levels"][1]["triangles"]);
    Ran within = run({"baked", "export", baked, "--error-m", "1e6", "-o", folder / "level.glb", "--json"});
    expect_done(within);
    EXPECT_EQ(json_of(within)["level"], made["levels"].size() - 1);
}

TEST(DiscreteCommands, BakeAndProveBillboardsWhereTheyAreAskedFor) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "windmills", "-o", folder.path(), "--count", "1"}));
    std::string mesh = folder / "windmill-2.glb", baked = folder / "windmill.ovl";
    auto rungs = [&](const char* impostors) {
        Ran baking = run({"bake-lod", "discrete", mesh, "-o", baked, "--impostors", impostors, "--json"});
        expect_done(baking);
        size_t boards = 0;
        nlohmann::json made = json_of(baking);
        for (const auto& level : made["levels"]) boards += level["rung"] == "billboards";
        return boards;
    };
    EXPECT_EQ(rungs("none"), 0u);
    size_t boards = rungs("cloud");
    EXPECT_GE(boards, 2u);
    Ran looking = run({"baked", "info", baked, "--json"});
    expect_done(looking);
    nlohmann::json levels = json_of(looking)["chain"]["levels"];
    EXPECT_EQ(std::count_if(levels.begin(), levels.end(), [](const auto& level) { return level["rung"] == "billboards"; }),
              int64_t(boards));
    Ran proving = run({"baked", "verify", baked, "--source", mesh, "--json"});
    expect_done(proving);
    nlohmann::json proof = json_of(proving);
    EXPECT_GE(proof["proven_levels"].get<size_t>(), boards);
    for (const auto& level : proof["levels"]) {
        if (level["rung"] == "billboards") {
            EXPECT_EQ(level["proven"], true);
        }
    }
    expect_refusal(run({"bake-lod", "discrete", mesh, "-o", baked, "--impostors", "many"}), 2, "bake-lod discrete", {"many"});
}

TEST(DiscreteCommands, BakeLevelsMadeByHandInTheirOrder) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "simple", "-o", folder.path(), "--count", "4"}));
    std::string ball = folder / "simple-0.glb", cube = folder / "simple-1.glb", baked = folder / "simple.ovl";
    Ran baking = run({"bake-lod", "discrete", ball, cube, "-o", baked, "--visibility", "optimised", "--json"});
    expect_done(baking);
    EXPECT_EQ(json_of(baking)["levels_from"], "files");
    // The middle of the cube's side is 0.2 m inside the ball, its corner 0.386 m outside.
    double error_m = json_of(baking)["levels"][1]["error_m"];
    EXPECT_GE(error_m, 0.385);
    EXPECT_LE(error_m, 0.40);
    expect_done(run({"baked", "verify", baked, "--source", ball, "--source", cube}));
    expect_refusal(run({"baked", "verify", baked, "--source", ball}), 2, "baked verify", {"from 2 files, 1 are given"});
    expect_refusal(run({"baked", "verify", baked, "--source", cube, "--source", ball}), 3, "baked verify", {"other bytes"});
}

TEST(DiscreteCommands, SayWhyALevelIsThere) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "simple", "-o", folder.path(), "--count", "1"}));
    Ran baking = run({"bake-lod", "discrete", folder / "simple-0.glb", "-o", folder / "a.ovl", "--why", "--factor", "1.2"});
    expect_done(baking);
    EXPECT_NE(baking.out.find("1080 pixels high over 60 degrees"), std::string::npos);
    EXPECT_NE(baking.out.find("the choice from 0 m to"), std::string::npos);
    EXPECT_NE(baking.out.find("1/1.4 is asked"), std::string::npos);
}

TEST(DiscreteCommands, ChooseMoreOrFewerLevelsByTheView) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "simple", "-o", folder.path(), "--count", "1"}));
    std::string ball = folder / "simple-0.glb";
    auto levels = [&](const std::string& error_px) {
        return json_of(run({"bake-lod", "discrete", ball, "-o", folder / "a.ovl", "--error-px", error_px, "--height-px", "64",
                            "--json"}))["levels"]
            .size();
    };
    EXPECT_LT(levels("0.02"), levels("1"));
}

TEST(DiscreteCommands, WriteTheSameBytesWithAnyThreadCount) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "windmills", "-o", folder.path(), "--count", "1"}));
    auto bytes = [&](const char* threads) {
        expect_done(run({"bake-lod", "discrete", folder / "windmill-1.glb", "-o", folder / "a.ovl", "--visibility", "optimised",
                         "--threads", threads}));
        return text_of_file(folder / "a.ovl");
    };
    EXPECT_EQ(bytes("1"), bytes("3"));
}

TEST(DiscreteCommands, RefuseWhatMakesNoSense) {
    ScratchFolder folder;
    expect_done(run({"make-sample", "simple", "-o", folder.path(), "--count", "1"}));
    std::string ball = folder / "simple-0.glb", cube = folder / "simple-1.glb", out = folder / "a.ovl";
    const char* name = "bake-lod discrete";
    expect_refusal(run({"bake-lod", "discrete", ball, "-o", ball}), 2, name, {"would be overwritten"});
    expect_refusal(run({"bake-lod", "discrete", ball, cube, "-o", out, "--levels-from", "cut"}), 2, name, {"cut from one mesh"});
    for (std::array<const char*, 2> option : {std::array{"--impostors", "cloud"}, std::array{"--plain-px", "9"}})
        expect_refusal(run({"bake-lod", "discrete", ball, cube, "-o", out, option[0], option[1]}), 2, name, {"made by hand"});
    expect_refusal(run({"bake-lod", "discrete", folder / "none.glb", "-o", out}), 3, name, {"none.glb"});
    expect_refusal(run({"bake-lod", "discrete", ball, "-o", out, "--visibility", folder / "none.png"}), 3, name, {"none.png"});
    expect_refusal(run({"bake-lod", "discrete", ball, "-o", folder / "no/such/folder.ovl"}), 4, name, {"no/such"});
    EXPECT_FALSE(std::filesystem::exists(out));

    expect_done(run({"bake-lod", "discrete", ball, "-o", out}));
    expect_refusal(run({"baked", "export", out, "-o", folder / "a.ply"}), 2, "baked export", {"--level or --error-m"});
    expect_refusal(run({"baked", "export", out, "--level", "31", "-o", folder / "a.ply"}), 2, "baked export", {"--level 31"});
    // A byte of the file another: its section does not match.
    std::string bytes = text_of_file(out);
    bytes[5000] = char(bytes[5000] ^ 1);
    std::ofstream(out, std::ios::binary) << bytes;
    expect_refusal(run({"baked", "info", out}), 3, "baked info", {"a.ovl"});
}

}  // namespace
}  // namespace overlook::cli
