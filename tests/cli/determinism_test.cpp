// The same input gives the same bytes, however many threads work on it.

#include <gtest/gtest.h>

#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::cli {
namespace {

void expect_same_bake(const ScratchFolder& folder, const std::string& dem) {
    std::string first;
    for (const char* threads : {"1", "2", "7", "7"}) {
        std::string baked = folder / "baked.ovl";
        expect_done(run({"bake-lod", "terrain", dem, "-o", baked, "--threads", threads, "--quiet"}));
        std::string bytes = text_of_file(baked);
        if (first.empty()) first = bytes;
        EXPECT_GT(bytes.size(), 4096u);
        EXPECT_TRUE(bytes == first) << "with " << threads << " threads";
    }
}

TEST(SameBytes, OfTheSampleBakedWithAnyThreadCount) {
    ScratchFolder folder;
    expect_same_bake(folder, make_dem(folder.path(), 257, 40));
}

TEST(SameBytes, OfEverestBakedWithAnyThreadCount) {
    if (dem_folder().empty()) GTEST_SKIP() << "set OVERLOOK_DATA to the folder of real elevation models";
    ScratchFolder folder;
    expect_same_bake(folder, dem_folder() + "everest_srtm3_voids.tif");
}

TEST(SameBytes, OfTheGeneratedElevationModelWithAnyThreadCount) {
    ScratchFolder folder;
    std::string first;
    for (const char* threads : {"1", "2", "7", "7"}) {
        expect_done(run({"make-sample", "dem", "-o", folder / threads, "--size", "257", "--voids", "5", "--seed", "3",
                         "--threads", threads, "--quiet"}));
        std::string bytes = text_of_file(folder / (std::string(threads) + "/dem.tif")) +
                            text_of_file(folder / (std::string(threads) + "/recipe.toml"));
        if (first.empty()) first = bytes;
        EXPECT_TRUE(bytes == first) << "with " << threads << " threads";
    }
    expect_done(run({"make-sample", "dem", "-o", folder / "other", "--size", "257", "--voids", "5", "--seed", "4", "--quiet"}));
    EXPECT_FALSE(text_of_file(folder / "other/dem.tif") == text_of_file(folder / "1/dem.tif"));
}

TEST(SameBytes, OfExportedCutsWithAnyThreadCount) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 257, 5), first;
    for (const char* threads : {"1", "7"}) {
        std::string all;
        for (const char* name : {"cut.ply", "cut.glb"}) {
            expect_done(run({"baked", "export", baked, "--error-m", "5", "-o", folder / name, "--threads", threads, "--quiet"}));
            all += text_of_file(folder / name);
        }
        if (first.empty()) first = all;
        EXPECT_TRUE(all == first) << "with " << threads << " threads";
    }
}

}  // namespace
}  // namespace overlook::cli
