// What `cmake --install` puts down serves projects outside: samples/read_terrain and samples/blend_levels.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/pipelines/shell.h"

namespace overlook {
namespace {

TEST(Installed, OutsideProjectFindsItAndReadsABakedTerrain) {
    shell::Scratch scratch;
    auto installed = shell::run("cmake --install '" OVERLOOK_BINARY_DIR "' --prefix prefix", scratch.path());
    ASSERT_EQ(installed.exit, 0) << installed.output;

    // A copy, so that nothing of the repository is within reach.
    auto built = shell::run("cp -r '" OVERLOOK_SOURCE_DIR
                            "/samples/read_terrain' program\n"
                            "cmake -S program -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" "
                            "-DCMAKE_CXX_COMPILER='" OVERLOOK_COMPILER "' -DCMAKE_CXX_FLAGS='" OVERLOOK_SANITIZE_FLAGS
                            "'\n"
                            "cmake --build build",
                            scratch.path());
    ASSERT_EQ(built.exit, 0) << built.output;

    // An installed tree may be moved: the module that reads the GeoTIFF is found from where the program is now.
    auto ran = shell::run(
        "mv prefix moved\n"
        "moved/bin/make-sample dem -o sample --size 129 --quiet\n"
        "LD_DEBUG=files LD_DEBUG_OUTPUT=loaded moved/bin/bake-lod terrain sample/dem.tif -o sample.ovl --quiet\n"
        "grep -q 'moved/lib.*/overlook/overlook_images.so' loaded.*\n"
        "build/read_terrain sample.ovl 0\n"
        "build/read_terrain sample.ovl 1e9",
        scratch.path());
    ASSERT_EQ(ran.exit, 0) << ran.output;
    EXPECT_NE(ran.output.find("samples: 129 x 129\n"), std::string::npos) << ran.output;
    EXPECT_NE(ran.output.find("triangles within 1e+09 m: 2\n"), std::string::npos) << ran.output;

    auto incomplete = shell::run(
        "rm moved/lib*/overlook/overlook_images.so || rm moved/lib/*/overlook/overlook_images.so\n"
        "moved/bin/bake-lod terrain sample/dem.tif -o again.ovl",
        scratch.path());
    EXPECT_EQ(incomplete.exit, 5) << incomplete.output;
    EXPECT_NE(incomplete.output.find("overlook_images.so, which reads and writes pictures, is neither in "), std::string::npos)
        << incomplete.output;

    auto refused = shell::run("build/read_terrain sample/dem.tif 0", scratch.path());
    EXPECT_EQ(refused.exit, 3) << refused.output;
}

// Of a square of 48 x 48 pixels the middle 32 x 32 are of both levels where the visibility lets half of the narrow one be seen.
TEST(Installed, OutsideProjectBlendsLevelsWithTheTwoShaderRoutines) {
    shell::Scratch scratch;
    auto installed = shell::run("cmake --install '" OVERLOOK_BINARY_DIR "' --prefix prefix", scratch.path());
    ASSERT_EQ(installed.exit, 0) << installed.output;
    auto built = shell::run("cp -r '" OVERLOOK_SOURCE_DIR
                            "/samples/blend_levels' program\n"
                            "cmake -S program -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=\"$PWD/prefix\" "
                            "-DCMAKE_CXX_COMPILER='" OVERLOOK_COMPILER "' -DCMAKE_CXX_FLAGS='" OVERLOOK_SANITIZE_FLAGS
                            "'\n"
                            "cmake --build build",
                            scratch.path());
    ASSERT_EQ(built.exit, 0) << built.output;
    auto ran = shell::run("build/blend_levels", scratch.path());
    ASSERT_EQ(ran.exit, 0) << ran.output;
    int wide = 0, narrow = -1, both = 0;
    ASSERT_EQ(std::sscanf(ran.output.c_str(), "the wide level: %d\nthe narrow level: %d\nboth: %d", &wide, &narrow, &both), 3)
        << ran.output;
    EXPECT_EQ(wide + both, 48 * 48) << "no pixel of the whole level is lost";
    EXPECT_EQ(narrow, 0) << "nothing of the narrow level is in front of the wide one";
    EXPECT_NEAR(both, 32 * 32 / 2, 64);
}

}  // namespace
}  // namespace overlook
