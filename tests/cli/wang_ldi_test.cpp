// bake-wang-ldi as a program: what it says, the same bytes whatever threads, and one line for whatever is wrong with a recipe.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// A meadow of one flower, with `more` at its end.
std::string write_recipe(const ScratchFolder& folder,
                         const std::string& model = "packing_radius_m = 0.5\ntight_radius_m = 0.45\n",
                         const std::string& top = "tile_size_m = 5.36\n") {
    write_text(folder / "flower.obj", "v 0 0 0\n");
    write_text(folder / "meadow.toml", top + "\n[[model]]\nfile = \"flower.obj\"\n" + model);
    return folder / "meadow.toml";
}

Ran bake(const ScratchFolder& folder, const Words& more = {}) {
    Words words{"bake-wang-ldi", folder / "meadow.toml", "-o", folder / "out.ovl"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
}

void expect_no_bake(const ScratchFolder& folder, int exit, const std::vector<std::string>& parts, const Words& more = {}) {
    auto before = contents_of(folder.path());
    expect_refusal(bake(folder, more), exit, "bake-wang-ldi", parts);
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(BakeWangLdi, MeasuresWhatItHasMade) {
    ScratchFolder folder;
    write_recipe(folder);
    Ran ran = bake(folder, {"--only", "planting", "--json", "--measure"});
    expect_done(ran);
    nlohmann::json report = nlohmann::json::parse(ran.out);
    EXPECT_EQ(report["tiles"]["count"], 12);
    EXPECT_LE(std::abs(report["tiles"]["correlation"].get<double>()), 0.02);
    EXPECT_EQ(report["tiles"]["disagreeing_neighbours"], 0);
    EXPECT_EQ(report["tiles"]["random_access_block"], 2);
    EXPECT_EQ(report["planting"]["tight_overlaps"], 0);
    EXPECT_EQ(report["planting"]["tiles_with_a_place"], 0);
    for (const char* zone : {"density_corner", "density_edge", "density_inside"}) {
        EXPECT_GE(report["planting"][zone], 0.95) << zone;
        EXPECT_LE(report["planting"][zone], 1.05) << zone;
    }
    EXPECT_GE(report["planting"]["relative_radius"], 0.7);
    EXPECT_EQ(report["planting"]["spectrum"]["radial_power"].size(), 32u);

    ran = run({"baked", "info", folder / "out.ovl", "--json"});
    expect_done(ran);
    nlohmann::json info = nlohmann::json::parse(ran.out);
    EXPECT_EQ(info["kind"], "WANG");
    EXPECT_EQ(info["ground"]["objects"], report["planting"]["objects"]);
    EXPECT_EQ(info["ground"]["edges"], report["tiles"]["edges"]);
    EXPECT_EQ(info["provenance"]["inputs"].size(), 2u);
}

TEST(BakeWangLdi, WritesSameBytesWithAnyThreadCount) {
    ScratchFolder folder;
    write_recipe(folder);
    std::string first;
    for (const char* threads : {"1", "2", "3"}) {
        expect_done(bake(folder, {"--only", "planting", "--quiet", "--threads", threads}));
        std::string bytes = text_of_file(folder / "out.ovl");
        EXPECT_TRUE(first.empty() || bytes == first);
        first = bytes;
    }
    expect_done(bake(folder, {"--only", "planting", "--quiet", "--seed", "2"}));
    EXPECT_FALSE(text_of_file(folder / "out.ovl") == first);
}

TEST(BakeWangLdi, BakesEverySetAndThePapersPlanting) {
    ScratchFolder folder;
    write_recipe(folder);
    for (const char* tiles : {"1", "8", "16", "robinson", "corners"}) {
        Ran ran = bake(folder, {"--only", "planting", "--tiles", tiles, "--json"});
        expect_done(ran);
        nlohmann::json report = nlohmann::json::parse(ran.out);
        EXPECT_EQ(report["tiles"]["count"], *tiles == 'r' || *tiles == 'c' ? 16 : std::stoi(tiles));
        EXPECT_EQ(report["planting"]["tight_overlaps"], 0) << tiles;
        double correlation = std::abs(report["tiles"]["correlation"].get<double>());
        if (std::string(tiles) == "robinson" || std::string(tiles) == "1") {
            EXPECT_GE(correlation, 0.5) << tiles;
        } else {
            EXPECT_LE(correlation, 0.02) << tiles;
        }
    }
    Ran ran = bake(folder, {"--only", "planting", "--planting", "paper", "--tiles", "8", "--json"});
    expect_done(ran);
    nlohmann::json report = nlohmann::json::parse(ran.out);
    EXPECT_EQ(report["planting"]["method"], "paper");
    EXPECT_GE(report["planting"]["more_per_tile"], 1);

    ran = bake(folder, {"--only", "planting", "--borders", "--variants", "2", "--json"});
    expect_done(ran);
    report = nlohmann::json::parse(ran.out);
    EXPECT_EQ(report["tiles"]["count"], 86);
    EXPECT_EQ(report["tiles"]["border_tiles"], 60);
    EXPECT_GE(report["tiles"]["border_bytes"], 60 * 28);
}

TEST(BakeWangLdi, ShowsItsTilesAsPictures) {
    ScratchFolder folder;
    write_recipe(folder);
    expect_done(bake(folder, {"--only", "planting", "--quiet"}));
    expect_done(run({"baked", "info", folder / "out.ovl", "--sheet", folder / "sheet"}));
    for (const char* name :
         {"tiles.png", "tiling-32.png", "tiling-256.png", "robinson-32.png", "robinson-256.png", "spectrum.png",
          "robinson-spectrum.png", "planting-neighbours.png", "planting-tiles.png", "planting.png"})
        EXPECT_GE(fs::file_size(folder / ("sheet/" + std::string(name))), 1000u) << name;
}

TEST(BakeWangLdi, ShowsRobinsonsSetWithVariants) {
    ScratchFolder folder;
    write_recipe(folder);
    expect_done(bake(folder, {"--only", "planting", "--quiet", "--tiles", "robinson", "--variants", "2"}));
    expect_done(run({"baked", "info", folder / "out.ovl", "--sheet", folder / "sheet"}));
}

TEST(BakeWangLdi, TakesTilesInPlaceOfTheRecipesOneTile) {
    ScratchFolder folder;
    write_recipe(folder, "packing_radius_m = 0.5\n", "tile_size_m = 5.36\ntiles = 1\ncandidates = 2\n");
    Ran ran = bake(folder, {"--only", "planting", "--tiles", "12", "--json"});
    expect_done(ran);
    EXPECT_EQ(nlohmann::json::parse(ran.out)["tiles"]["count"], 12);
    ran = bake(folder, {"--only", "planting", "--colours", "1", "--json"});
    expect_done(ran);
    EXPECT_EQ(nlohmann::json::parse(ran.out)["tiles"]["count"], 1);
    expect_no_bake(folder, 2, {"12 tiles of one colour each way"}, {"--colours", "1", "--tiles", "12"});
}

TEST(BadRecipe, ThatIsMissingOrNoToml) {
    ScratchFolder folder;
    expect_no_bake(folder, 3, {"meadow.toml", "No such file"});
    write_text(folder / "meadow.toml", "tile_size_m = 5\nseed = = 3\n");
    expect_no_bake(folder, 3, {"meadow.toml:2"});
    fs::remove(folder / "meadow.toml"), fs::create_directory(folder / "meadow.toml");
    expect_no_bake(folder, 3, {"meadow.toml", "is a folder"});
}

TEST(BadRecipe, WithAnUnknownKeyIsToldTheNearest) {
    ScratchFolder folder;
    write_recipe(folder, "packing_radius_m = 0.5\ntight_radius = 0.4\n");
    expect_no_bake(folder, 3,
                   {"meadow.toml:6", "model 1", "\"tight_radius\" is not a key here", "did you mean \"tight_radius_m\"?"});
    write_recipe(folder, "packing_radius_m = 0.5\n", "tile_size_m = 5.36\ntile = 8\n");
    expect_no_bake(folder, 3, {"meadow.toml:2", "\"tile\"", "did you mean \"tiles\"?"});
}

TEST(BadRecipe, WithAMissingModel) {
    ScratchFolder folder;
    write_recipe(folder);
    fs::remove(folder / "flower.obj");
    expect_no_bake(folder, 3, {"meadow.toml:4", "model 1", "\"flower.obj\" is missing"});
    write_text(folder / "meadow.toml", "tile_size_m = 5\n");
    expect_no_bake(folder, 3, {"model: there is none"});
}

TEST(BadRecipe, WithARadiusOfZeroOrLargerThanTheTile) {
    ScratchFolder folder;
    write_recipe(folder, "packing_radius_m = 0\n");
    expect_no_bake(folder, 3, {"meadow.toml:5", "packing_radius_m: 0 is not a number from 1e-06"});
    write_recipe(folder, "packing_radius_m = 0.5\ntight_radius_m = 0\n");
    expect_no_bake(folder, 3, {"meadow.toml:6", "tight_radius_m: 0"});
    write_recipe(folder, "packing_radius_m = 6\n");
    expect_no_bake(folder, 3, {"packing_radius_m: 6 m is larger than the tile of 5.36 m"});
    write_recipe(folder, "tight_radius_m = 0.5\n");
    expect_no_bake(folder, 3, {"packing_radius_m: is missing"});
    write_recipe(folder, "packing_radius_m = 1.5\n");
    expect_no_bake(folder, 3, {"tile_size_m: 5.36 is too small"});
}

TEST(BadRecipe, WithADensityThatCannotBeMetIsToldHowManyFitted) {
    ScratchFolder folder;
    write_recipe(folder, "packing_radius_m = 0.5\n", "tile_size_m = 5.36\ndensity_per_m2 = 3\n");
    expect_no_bake(folder, 3, {"density_per_m2: 3 a square metre do not fit; 0.7", "on a tile of 5.36 m"});
    write_recipe(folder, "packing_radius_m = 0.5\n[[model]]\nfile = \"flower.obj\"\npacking_radius_m = 2\nper_tile = 9\n");
    expect_no_bake(folder, 3, {"per_tile: 9 of packing radius 2 m do not fit inside a tile of 5.36 m; 1 did"});
}

TEST(BadRecipe, WithRangesThatContradict) {
    ScratchFolder folder;
    const char* radii = "packing_radius_m = 0.5\n";
    auto expect = [&](const std::string& more, const std::vector<std::string>& parts) {
        SCOPED_TRACE(more);
        write_recipe(folder, radii + more);
        expect_no_bake(folder, 3, parts);
    };
    expect("scale = [1.2, 0.8]\n", {"meadow.toml:6", "scale: 1.2 to 0.8 is no range"});
    expect("scale = [1, 2, 3]\n", {"scale: two numbers"});
    expect("scale = [1, 20]\n", {"scale: 20 times packing_radius_m is 10 m"});
    expect("turn_deg = [180, 90]\n", {"turn_deg: 180 to 90 is no range"});
    expect("turn_deg = \"any\"\n", {"turn_deg"});
    expect("tight_radius_m = 0.6\n", {"tight_radius_m: 0.6 m is larger than packing_radius_m, 0.5 m"});
    expect("share = 2\ndensity_per_m2 = 0.5\n", {"share: contradicts density_per_m2"});
    expect("share = 2\nper_tile = 1\n", {"per_tile: contradicts share"});
    expect("variants = [1]\n", {"variants: is of models that stand per_tile"});
    expect("per_tile = 1\n", {"all stand per_tile"});
    expect("share = 0\n", {"share: 0 is not a number"});
    expect("density_per_m2 = 0.3\n[[model]]\nfile = \"flower.obj\"\npacking_radius_m = 0.4\n",
           {"density_per_m2: some models say it"});
}

TEST(BadRecipe, OfASetThatIsNone) {
    ScratchFolder folder;
    for (const char* tiles : {"13", "0", "\"twelve\"", "1000", "true"}) {
        write_recipe(folder, "packing_radius_m = 0.5\n", std::string("tile_size_m = 5.36\ntiles = ") + tiles + "\n");
        expect_no_bake(folder, 3, {"meadow.toml", "tiles"});
    }
    write_recipe(folder);
    expect_no_bake(folder, 2, {"13 tiles of 2 x 2 colours"}, {"--tiles", "13"});
    expect_no_bake(folder, 2, {"--tiles", "\"twelve\" is no set of tiles"}, {"--tiles", "twelve"});
    expect_no_bake(folder, 2, {"255"}, {"--tiles", "16", "--variants", "200"});
}

TEST(BadOutput, IsRefusedBeforeAnythingIsLost) {
    ScratchFolder folder;
    std::string recipe = write_recipe(folder);
    auto before = contents_of(folder.path());
    expect_refusal(run({"bake-wang-ldi", recipe, "-o", recipe}), 2, "bake-wang-ldi", {"would be overwritten"});
    expect_refusal(run({"bake-wang-ldi", recipe, "-o", folder / "flower.obj", "--only", "planting"}), 2, "bake-wang-ldi",
                   {"flower.obj", "would be overwritten"});
    expect_refusal(run({"bake-wang-ldi", recipe, "-o", folder / "none/out.ovl"}), 4, "bake-wang-ldi", {"none/out.ovl"});
    expect_refusal(run({"baked", "info", recipe}), 3, "baked info", {"C1"});
    EXPECT_EQ(contents_of(folder.path()), before);
}

}  // namespace
}  // namespace overlook::cli
