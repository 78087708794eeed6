// OpenImageIO is in a module that a command opens when it meets a picture: not before, and where it is missing it says so.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/pipelines/shell.h"

namespace overlook {
namespace {

// `command` in `folder`, with the dynamic loader's log of every library: what a process loads while it runs is in no program's
// head.
shell::Ran loaded_by(const std::string& command, const std::string& folder) {
    return shell::run(
        "export LD_DEBUG=files LD_DEBUG_OUTPUT=loaded\n" + command +
            "\nunset LD_DEBUG LD_DEBUG_OUTPUT\nrm -f whole.log\ncat loaded.* > whole.log\nrm loaded.*\ncat whole.log",
        folder);
}
bool names(const shell::Ran& ran, const std::string& library) {
    return ran.output.find(library) != std::string::npos;
}

constexpr const char* kMesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n";
constexpr const char* kMakeDem = "make-sample dem -o sample --size 65 --quiet";

TEST(ImageModule, CommandWithoutPicturesLoadsNoOpenImageIO) {
    shell::Scratch scratch;
    shell::write_file(scratch.path() + "/one.obj", kMesh);
    for (const char* command : {"bake-lod --version", "baked --version", "make-sample --version",
                                "bake-lod mesh one.obj -o one.ovl --quiet", "baked verify one.ovl --source one.obj --quiet"}) {
        auto ran = loaded_by(command, scratch.path());
        ASSERT_EQ(ran.exit, 0) << command << ": " << ran.output.substr(0, 2000);
        EXPECT_TRUE(names(ran, "libfmt.so")) << command << ": the loader's log names nothing";
        for (const char* library : {"overlook_images.so", "libOpenImageIO", "libopencv", "libgdal"})
            EXPECT_FALSE(names(ran, library)) << command << " loads " << library;
    }
}

TEST(ImageModule, CommandThatReadsAPictureLoadsIt) {
    shell::Scratch scratch;
    ASSERT_EQ(shell::run(kMakeDem, scratch.path()).exit, 0);
    auto ran = loaded_by("bake-lod terrain sample/dem.tif -o dem.ovl --quiet", scratch.path());
    ASSERT_EQ(ran.exit, 0) << ran.output.substr(0, 2000);
    EXPECT_TRUE(names(ran, "overlook_images.so"));
    EXPECT_TRUE(names(ran, "libOpenImageIO"));
}

TEST(ImageModule, IsMissedInOneLineOnlyWherePicturesAre) {
    shell::Scratch scratch;
    shell::write_file(scratch.path() + "/one.obj", kMesh);
    ASSERT_EQ(shell::run(std::string(kMakeDem) + "\nmkdir -p lone/bin\ncp '" OVERLOOK_BINARY_DIR "/bin/bake-lod' lone/bin/",
                         scratch.path())
                  .exit,
              0);
    auto refused = shell::run("lone/bin/bake-lod terrain sample/dem.tif -o dem.ovl", scratch.path());
    EXPECT_EQ(refused.exit, 5) << refused.output;
    EXPECT_EQ(std::count(refused.output.begin(), refused.output.end(), '\n'), 1) << refused.output;
    EXPECT_EQ(refused.output.rfind("bake-lod terrain: overlook_images.so, which reads and writes pictures, is neither in ", 0),
              0u)
        << refused.output;
    EXPECT_TRUE(names(refused, "/lone/bin nor in ")) << refused.output;
    EXPECT_TRUE(names(refused, "install Overlook whole")) << refused.output;

    auto baked = shell::run("test ! -e dem.ovl\nlone/bin/bake-lod mesh one.obj -o one.ovl --quiet", scratch.path());
    EXPECT_EQ(baked.exit, 0) << baked.output;
}

TEST(ImageModule, SaysWhatTheLoaderSaysOfOneThatIsDamaged) {
    shell::Scratch scratch;
    auto refused = shell::run(std::string(kMakeDem) + "\nmkdir lone\ncp '" OVERLOOK_BINARY_DIR
                                                      "/bin/bake-lod' lone/\necho 'no library' > lone/overlook_images.so\n"
                                                      "lone/bake-lod terrain sample/dem.tif -o dem.ovl",
                              scratch.path());
    EXPECT_EQ(refused.exit, 5) << refused.output;
    EXPECT_EQ(std::count(refused.output.begin(), refused.output.end(), '\n'), 1) << refused.output;
    EXPECT_TRUE(names(refused, "lone/overlook_images.so cannot be loaded: ")) << refused.output;
}

}  // namespace
}  // namespace overlook
