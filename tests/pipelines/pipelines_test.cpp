// The pipelines themselves: what they say, and what they refuse.
#include <gtest/gtest.h>

#include "tests/pipelines/shell.h"

namespace overlook {
namespace {

const std::string kRoot = OVERLOOK_SOURCE_DIR;

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Pipelines, SayTheirStepsInOrderWithoutTakingThem) {
    auto quickstart = shell::run("env -u DISPLAY -u WAYLAND_DISPLAY pipelines/quickstart --dry-run", kRoot);
    EXPECT_EQ(quickstart.exit, 0);
    size_t install = quickstart.output.find("install what is missing"), build = quickstart.output.find("build");
    size_t bake = quickstart.output.find("bake it"), draw = quickstart.output.find("draw it");
    ASSERT_NE(draw, std::string::npos) << quickstart.output;
    EXPECT_TRUE(install < build && build < bake && bake < draw) << quickstart.output;
    EXPECT_FALSE(contains(quickstart.output, " failed")) << quickstart.output;
}

TEST(Pipelines, CountAsManyStepsAsTheySay) {
    for (const char* pipeline : {"quickstart", "test", "bench", "charts", "stability", "lod-sprite", "caveclod", "fsi",
                                 "wang-ldi", "proofs", "peers", "nightly"}) {
        auto ran = shell::run(std::string("pipelines/") + pipeline + " --dry-run | tail -n 1", kRoot);
        int index = 0, count = 0;
        ASSERT_EQ(std::sscanf(ran.output.c_str(), "== %d/%d", &index, &count), 2) << pipeline << ": " << ran.output;
        EXPECT_EQ(index, count) << pipeline;
    }
}

TEST(Pipelines, BenchBuildsWithItsPackageBeforeItMeasures) {
    auto bench = shell::run("pipelines/bench --dry-run", kRoot);
    EXPECT_EQ(bench.exit, 0) << bench.output;
    size_t install = bench.output.find("install what is missing"), configure = bench.output.find("configure");
    size_t build = bench.output.find("build"), measure = bench.output.find("measure: out/bench");
    ASSERT_NE(measure, std::string::npos) << bench.output;
    EXPECT_TRUE(install < configure && configure < build && build < measure) << bench.output;
    EXPECT_TRUE(contains(shell::read_file(kRoot + "/pipelines/packages.txt"), "\nlibbenchmark-dev\n"));
}

TEST(Pipelines, RefuseAnOptionTheyDoNotKnow) {
    for (const char* pipeline : {"quickstart", "bench", "charts", "stability", "lod-sprite", "caveclod", "fsi", "wang-ldi",
                                 "proofs", "peers", "nightly", "set-up"}) {
        auto ran = shell::run(std::string("pipelines/") + pipeline + " --wrong", kRoot);
        EXPECT_EQ(ran.exit, 2) << pipeline << ": " << ran.output;
        EXPECT_TRUE(contains(ran.output, "--wrong is not an option")) << ran.output;
    }
}

// Of programs that stand for the built ones: nothing listed is not the same as nothing to do.
TEST(Pipelines, FailWhereTheirMeshesCannotBeMade) {
    shell::Scratch scratch;
    std::string root = scratch.path() + "/root";
    auto made = shell::run("mkdir -p root/pipelines root/bin root/build/release/bin && cd root && cp '" + kRoot +
                               "'/pipelines/{peers,proofs,steps.sh} pipelines/\n"
                               "for program in pipelines/set-up bin/cmake; do printf '#!/bin/sh\\n' >$program; done\n"
                               "printf '#!/bin/sh\\nexit 3\\n' >build/release/bin/make-sample\n"
                               "printf '#!/bin/sh\\necho 9 cuts by CGAL\\n' >build/release/bin/caveclod_hausdorff_test\n"
                               "chmod +x pipelines/set-up bin/* build/release/bin/*",
                           scratch.path());
    ASSERT_EQ(made.exit, 0) << made.output;
    for (const char* pipeline : {"peers", "proofs"}) {
        auto ran = shell::run(std::string("PATH=\"$PWD/bin:$PATH\" env -u OVERLOOK_DATA pipelines/") + pipeline, root);
        EXPECT_NE(ran.exit, 0) << ran.output;
        EXPECT_TRUE(contains(ran.output, "4/4 failed with exit code")) << ran.output;
        EXPECT_FALSE(contains(ran.output, "meshes,")) << ran.output;
    }
}

TEST(Pipelines, FindWhichPackagesAreMissing) {
    shell::Scratch scratch;
    shell::write_file(scratch.path() + "/list", "# a comment\nbash\nno-such-package-here  # another\nbas\n");
    auto ran = shell::run("'" + kRoot + "/pipelines/set-up' --dry-run list", scratch.path());
    EXPECT_EQ(ran.exit, 0);
    EXPECT_EQ(ran.output, "set-up: would install 2 packages: bas no-such-package-here\n");
}

TEST(Pipelines, BareMakeSaysWhatThereIs) {
    auto ran = shell::run("make -C pipelines", kRoot);
    EXPECT_EQ(ran.exit, 0) << ran.output;
    for (const char* target : {"quickstart", "test", "sample", "bake", "bench", "charts", "stability", "lod-sprite", "caveclod",
                               "fsi", "wang-ldi", "proofs", "peers", "docs", "nightly"}) {
        EXPECT_TRUE(contains(ran.output, std::string("  ") + target + " ")) << target << "\n" << ran.output;
    }
}

TEST(Pipelines, MakeBakeWantsAnElevationModel) {
    auto none = shell::run("make -C pipelines bake", kRoot);
    EXPECT_NE(none.exit, 0);
    EXPECT_TRUE(contains(none.output, "make -C pipelines bake DEM=your.tif")) << none.output;
    auto missing = shell::run("make -C pipelines bake DEM=no/such.tif", kRoot);
    EXPECT_NE(missing.exit, 0);
    EXPECT_TRUE(contains(missing.output, "no/such.tif: cannot be read")) << missing.output;
}

}  // namespace
}  // namespace overlook
