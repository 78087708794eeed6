// Meshes through the commands: baked, looked at, proven, exported.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

// A torus of 2 * around * across triangles with bumps, texture coordinates, and therefore seams, as OBJ.
std::string bumpy_torus(uint32_t around, uint32_t across) {
    std::string text = "o torus\n";
    constexpr double kTurn = 6.283185307179586;
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < across; ++j) {
            double u = kTurn * i / around, v = kTurn * j / across, r = 1 + 0.05 * std::sin(5 * u) * std::cos(3 * v);
            text += "v " + std::to_string((3 + r * std::cos(v)) * std::cos(u)) + " " +
                    std::to_string((3 + r * std::cos(v)) * std::sin(u)) + " " + std::to_string(r * std::sin(v)) + "\n";
        }
    for (uint32_t i = 0; i <= around; ++i)
        for (uint32_t j = 0; j <= across; ++j)
            text += "vt " + std::to_string(double(i) / around) + " " + std::to_string(double(j) / across) + "\n";
    auto corner = [&](uint32_t i, uint32_t j) {
        return " " + std::to_string(i % around * across + j % across + 1) + "/" + std::to_string(i * (across + 1) + j + 1);
    };
    for (uint32_t i = 0; i < around; ++i)
        for (uint32_t j = 0; j < across; ++j)
            text += "f" + corner(i, j) + corner(i + 1, j) + corner(i + 1, j + 1) + corner(i, j + 1) + "\n";
    return text;
}

std::string write_torus(const ScratchFolder& folder) {
    std::string path = folder / "torus.obj";
    write_text(path, bumpy_torus(40, 20));
    return path;
}

nlohmann::json json_of(const Ran& ran) {
    return nlohmann::json::parse(ran.out);
}

TEST(MeshCommands, BakeLookProveAndExport) {
    ScratchFolder folder;
    std::string mesh = write_torus(folder), baked = folder / "torus.ovl";
    Ran baking = run({"bake-lod", "mesh", mesh, "-o", baked, "--json"});
    expect_done(baking);
    EXPECT_EQ(json_of(baking)["triangles"], 1600);
    EXPECT_LT(json_of(baking)["triangles_coarsest"].get<int>(), 400);

    Ran looking = run({"baked", "info", baked, "--json"});
    expect_done(looking);
    EXPECT_EQ(json_of(looking)["mesh"]["triangles"], 1600);
    EXPECT_EQ(json_of(looking)["mesh"]["render_vertices"], 41 * 21);

    Ran proving = run({"baked", "verify", baked, "--source", mesh, "--cuts", "50", "--json"});
    expect_done(proving);
    EXPECT_EQ(json_of(proving)["holds"], true);
    EXPECT_EQ(json_of(proving)["lost_triangles"], 0);
    EXPECT_LT(json_of(proving)["cuts"]["median_stated_over_measured"].get<double>(), 1.5);

    uint64_t all = 0;
    for (const char* error_m : {"0.01", "0.1", "0.5"}) {
        Ran exporting = run({"baked", "export", baked, "--error-m", error_m, "-o", folder / "cut.ply", "--json"});
        expect_done(exporting);
        EXPECT_LE(json_of(exporting)["stated_error_m"].get<double>(), std::stod(error_m));
        uint64_t triangles = json_of(exporting)["triangles"];
        EXPECT_TRUE(all == 0 || triangles < all) << triangles;
        all = triangles;
    }
    for (const char* colour : {"source", "group", "id", "class"})
        expect_done(run({"baked", "export", baked, "--error-m", "0.1", "-o", folder / "cut.glb", "--colour", colour}));
}

TEST(MeshCommands, ExportedCutsAreMeshesThatBakeAgain) {
    ScratchFolder folder;
    std::string baked = folder / "torus.ovl", cut = folder / "cut.ply";
    expect_done(run({"bake-lod", "mesh", write_torus(folder), "-o", baked}));
    Ran exporting = run({"baked", "export", baked, "--error-m", "0.1", "-o", cut, "--json"});
    Ran again = run({"bake-lod", "mesh", cut, "-o", folder / "again.ovl", "--json"});
    expect_done(again);
    EXPECT_EQ(json_of(again)["triangles"], json_of(exporting)["triangles"]);
    EXPECT_EQ(json_of(again)["cut_edges"], 0);
}

TEST(MeshCommands, GiveTheSameBytesWithAnyThreadCount) {
    ScratchFolder folder;
    std::string mesh = write_torus(folder), first;
    for (const char* seams : {"strict", "budgeted"}) {
        first.clear();
        for (const char* threads : {"1", "2", "7"}) {
            expect_done(run({"bake-lod", "mesh", mesh, "-o", folder / "baked.ovl", "--threads", threads, "--seams", seams,
                             "--seam-texels", "20"}));
            std::string bytes = text_of_file(folder / "baked.ovl");
            if (first.empty()) first = bytes;
            EXPECT_TRUE(bytes == first) << threads << " threads, " << seams;
        }
    }
    for (const char* codec : {"meshopt", "draco"}) {
        first.clear();
        for (const char* threads : {"1", "2", "7"}) {
            expect_done(run({"bake-lod", "mesh", mesh, "-o", folder / "baked.ovl", "--threads", threads, "--codec", codec}));
            std::string bytes = text_of_file(folder / "baked.ovl");
            if (first.empty()) first = bytes;
            EXPECT_TRUE(bytes == first) << threads << " threads, " << codec;
        }
    }
}

TEST(MeshCommands, SeamsThatMayMoveAreToldBeforeAndProvenAfter) {
    ScratchFolder folder;
    std::string mesh = write_torus(folder), baked = folder / "torus.ovl";
    Ran baking = run({"bake-lod", "mesh", mesh, "-o", baked, "--seams", "budgeted", "--seam-texels", "60"});
    expect_done(baking);
    EXPECT_NE(baking.err.find("with strict seams"), std::string::npos) << baking.err;
    Ran proving = run({"baked", "verify", baked, "--source", mesh, "--cuts", "30", "--json"});
    expect_done(proving);
    EXPECT_EQ(json_of(proving)["holds"], true);
    EXPECT_EQ(json_of(proving)["seams"]["wrong"], 0);
    EXPECT_LE(json_of(proving)["seams"]["uv_error_texels"].get<double>(), 60.001);
    Ran looking = run({"baked", "info", baked, "--json"});
    expect_done(looking);
    EXPECT_LE(std::stod(json_of(looking)["provenance"]["options"]["found-seam-texels"].get<std::string>()), 60);
}

TEST(MeshCommands, RefuseWhatIsNoMeshAndLeaveTheOutputWhole) {
    ScratchFolder folder;
    write_text(folder / "out.ovl", "an older file");
    write_text(folder / "empty.obj", "");
    write_text(folder / "broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n");
    auto before = contents_of(folder.path());
    for (const char* name : {"missing.obj", "empty.obj", "broken.obj"})
        expect_refusal(run({"bake-lod", "mesh", folder / name, "-o", folder / "out.ovl"}), 3, "bake-lod mesh", {name});
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(MeshCommands, RefuseAnotherSourceAndErrorsThatCannotBeKept) {
    ScratchFolder folder;
    std::string mesh = write_torus(folder), baked = folder / "torus.ovl";
    expect_done(run({"bake-lod", "mesh", mesh, "-o", baked}));
    expect_refusal(run({"bake-lod", "mesh", mesh, "-o", mesh}), 2, "bake-lod mesh", {mesh, "overwritten"});
    expect_refusal(run({"baked", "export", baked, "--error-m", "1e-9", "-o", folder / "cut.ply"}), 5, "baked export", {baked});
    write_text(mesh, bumpy_torus(41, 20));
    expect_refusal(run({"baked", "verify", baked, "--source", mesh}), 3, "baked verify", {mesh, "other bytes"});
}

}  // namespace
}  // namespace overlook::cli
