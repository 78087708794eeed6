// What `cmake --install` puts down serves projects outside: samples/read_terrain and samples/blend_levels.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/pipelines/shell.h"

namespace overlook {
namespace {

// Installs into prefix/ and builds a copy of samples/NAME beside it in build/, so that nothing of the repository is within reach.
void build_outside(const shell::Scratch& scratch, const std::string& name) {
    auto built = shell::run("cmake --install '" OVERLOOK_BINARY_DIR
                            "' --prefix prefix\n"
                            "cp -r '" OVERLOOK_SOURCE_DIR "/samples/" +
                                name +
                                "' program\n"
                                "cmake -S program -B build -G Ninja -DCMAKE_BUILD_TYPE=Release "
                                "-DCMAKE_PREFIX_PATH=\"$PWD/prefix\" -DCMAKE_CXX_COMPILER='" OVERLOOK_COMPILER
                                "' -DCMAKE_CXX_FLAGS='" OVERLOOK_SANITIZE_FLAGS
                                "'\n"
                                "cmake --build build",
                            scratch.path());
    ASSERT_EQ(built.exit, 0) << built.output;
}

TEST(Installed, OutsideProjectFindsItAndReadsABakedTerrain) {
    shell::Scratch scratch;
    ASSERT_NO_FATAL_FAILURE(build_outside(scratch, "read_terrain"));

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
    ASSERT_NO_FATAL_FAILURE(build_outside(scratch, "blend_levels"));
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
