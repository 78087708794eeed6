// Whatever is wrong with what is read, or with where it is to be written: one line that names it, the right exit code, nothing
// half-written.

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/inputs.h"
#include "tests/cli/run_command.h"
#include "tests/formats/scratch_folder.h"
#include "tests/formats/small_disk.h"

namespace overlook::cli {
namespace {

namespace fs = std::filesystem;

// Bakes `dem` over an older file and expects a refusal that names the elevation model, with everything left as it was.
void expect_no_bake(const ScratchFolder& folder, const std::string& dem, const std::string& part) {
    write_text(folder / "out.ovl", "an older file");
    auto before = contents_of(folder.path());
    expect_refusal(run({"bake-lod", "terrain", dem, "-o", folder / "out.ovl"}), 3, "bake-lod terrain", {dem, part});
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(BadInput, MissingFile) {
    ScratchFolder folder;
    expect_no_bake(folder, folder / "missing.tif", "No such file");
}

TEST(BadInput, FolderInPlaceOfAFile) {
    ScratchFolder folder;
    expect_no_bake(folder, folder.path(), "is a folder");
}

TEST(BadInput, EmptyFile) {
    ScratchFolder folder;
    for (const char* name : {"a.tif", "N10E010.hgt", "a.png"}) {
        write_text(folder / name, "");
        expect_no_bake(folder, folder / name, "is empty");
    }
}

TEST(BadInput, TiffCutShortAnywhere) {
    ScratchFolder folder;
    std::string whole = text_of_file(make_dem(folder.path(), 65));
    ASSERT_GT(whole.size(), 1000u);
    for (size_t length :
         {size_t(1), size_t(4), size_t(8), size_t(9), size_t(100), whole.size() / 3, whole.size() / 2, whole.size() - 1}) {
        write_text(folder / "cut.tif", whole.substr(0, length));
        expect_no_bake(folder, folder / "cut.tif", "cut.tif");
    }
}

TEST(BadInput, TextNamedTiff) {
    ScratchFolder folder;
    write_text(folder / "text.tif", "These are not the heights you are looking for.\n");
    expect_no_bake(folder, folder / "text.tif", "is no elevation model that is read");
}

TEST(BadInput, HgtOfOddLength) {
    ScratchFolder folder;
    for (size_t length : {1u, 101u, 1201u * 1201u * 2u - 1u, 1201u * 1201u * 2u + 2u}) {
        write_text(folder / "N10E010.hgt", std::string(length, '\1'));
        expect_no_bake(folder, folder / "N10E010.hgt", std::to_string(length) + " bytes");
    }
}

TEST(BadInput, NothingButVoids) {
    ScratchFolder folder;
    write_hgt(folder / "N10E010.hgt", 1201, [](uint32_t, uint32_t) { return -32768; });
    expect_no_bake(folder, folder / "N10E010.hgt", "all of its 1201 x 1201 samples are void");
}

TEST(BadInput, UnknownReferenceSystem) {
    ScratchFolder folder;
    std::string bytes = text_of_file(make_dem(folder.path(), 65));
    const char projected[] = {0x00, 0x0c, 0, 0, 1, 0};  // GeoKey 3072, in place, one value
    size_t key = bytes.find(std::string(projected, sizeof projected));
    ASSERT_NE(key, std::string::npos);
    bytes[key + 6] = char(20790 & 0xff), bytes[key + 7] = char(20790 >> 8);  // a grid of Portugal
    write_text(folder / "portugal.tif", bytes);
    expect_no_bake(folder, folder / "portugal.tif", "20790");
}

TEST(BadInput, PictureThatIsNone) {
    ScratchFolder folder;
    std::string dem = make_dem(folder.path(), 65), picture = folder / "picture.jpg";
    write_text(picture, "no picture");
    auto before = contents_of(folder.path());
    expect_refusal(run({"bake-lod", "terrain", dem, "--texture", picture, "-o", folder / "out.ovl"}), 3, "bake-lod terrain",
                   {picture});
    expect_refusal(run({"bake-lod", "terrain", dem, "--texture", folder / "missing.jpg", "-o", folder / "out.ovl"}), 3,
                   "bake-lod terrain", {"missing.jpg"});
    EXPECT_EQ(contents_of(folder.path()), before);
}

// Every reader of baked files, on files that are none or are damaged at some byte.
void expect_no_reading(const ScratchFolder& folder, const std::string& file, const std::string& part) {
    auto before = contents_of(folder.path());
    expect_refusal(run({"player", file, "--headless", "--image", folder / "out.png"}), 3, "player", {file, part});
    expect_refusal(run({"baked", "export", file, "--error-m", "10", "-o", folder / "out.ply"}), 3, "baked export", {file, part});
    expect_refusal(run({"baked", "verify", file, "--source", file}), 3, "baked verify", {file, part});
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(BadInput, NoBakedFile) {
    ScratchFolder folder;
    write_text(folder / "text.ovl", std::string(5000, 'x'));
    write_text(folder / "empty.ovl", "");
    expect_no_reading(folder, folder / "text.ovl", "C1");
    expect_no_reading(folder, folder / "empty.ovl", "empty.ovl");
    expect_no_reading(folder, folder / "missing.ovl", "No such file");
    expect_refusal(run({"baked", "info", folder / "text.ovl"}), 3, "baked info", {"C1"});
    expect_refusal(run({"baked", "diff", folder / "text.ovl", folder / "text.ovl"}), 3, "baked diff", {"C1"});
}

TEST(BadInput, DamagedBakedFile) {
    ScratchFolder folder;
    std::string whole = text_of_file(make_baked(folder.path(), 65));
    write_text(folder / "bad.ovl", whole.substr(0, whole.size() / 2));
    expect_no_reading(folder, folder / "bad.ovl", ": C");
    for (size_t at : {size_t(10), size_t(70), size_t(4100), whole.size() / 2, whole.size() - 300}) {
        std::string damaged = whole;
        damaged[at] = char(damaged[at] ^ 0x10);
        write_text(folder / "bad.ovl", damaged);
        expect_no_reading(folder, folder / "bad.ovl", "bad.ovl: ");
    }
}

// Every command that writes, writing to `file`.
struct Writing {
    std::string name;
    std::vector<std::string> words;
};
std::vector<Writing> all_writing(const std::string& dem, const std::string& baked, const std::string& stem) {
    return {{"bake-lod terrain", {"bake-lod", "terrain", dem, "-o", stem + ".ovl"}},
            {"baked export", {"baked", "export", baked, "--error-m", "1", "-o", stem + ".ply"}},
            {"baked export", {"baked", "export", baked, "--error-m", "1", "-o", stem + ".glb"}},
            {"player", {"player", baked, "--headless", "--size", "320x200", "--image", stem + ".png"}}};
}

TEST(UnwritableOutput, FolderOfThatName) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    for (const char* end : {".ovl", ".ply", ".glb", ".png", ".json"}) fs::create_directory(folder / ("out" + std::string(end)));
    auto before = contents_of(folder.path());
    for (const Writing& writing : all_writing(folder / "sample/dem.tif", baked, folder / "out"))
        expect_refusal(run(writing.words), 4, writing.name, {writing.words.back(), "Is a directory"});
    expect_refusal(run({"player", baked, "--headless", "--size", "64x64", "--report", folder / "out.json"}), 4, "player",
                   {"out.json", "Is a directory"});
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(UnwritableOutput, FileInPlaceOfItsFolder) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    write_text(folder / "file", "not a folder");
    auto before = contents_of(folder.path());
    for (const Writing& writing : all_writing(folder / "sample/dem.tif", baked, folder / "file/out"))
        expect_refusal(run(writing.words), 4, writing.name, {writing.words.back(), "Not a directory"});
    expect_refusal(run({"make-sample", "dem", "--size", "65", "-o", folder / "file/out"}), 4, "make-sample dem", {"file/out"});
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(UnwritableOutput, FolderThatIsNotThere) {
    ScratchFolder folder;
    std::string baked = make_baked(folder.path(), 65);
    auto before = contents_of(folder.path());
    for (const Writing& writing : all_writing(folder / "sample/dem.tif", baked, folder / "new/out"))
        expect_refusal(run(writing.words), 4, writing.name, {writing.words.back(), "make the folder"});
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(UnwritableOutput, InputOfTheSameName) {
    ScratchFolder folder;
    std::string dem = make_dem(folder.path(), 65);
    fs::create_symlink(dem, folder / "link.ovl");
    auto before = contents_of(folder.path());
    expect_refusal(run({"bake-lod", "terrain", dem, "-o", dem}), 2, "bake-lod terrain", {dem, "would be overwritten"});
    expect_refusal(run({"bake-lod", "terrain", dem, "-o", folder / "link.ovl"}), 2, "bake-lod terrain",
                   {"link.ovl", "would be overwritten"});
    EXPECT_EQ(contents_of(folder.path()), before);
}

// Over older files, which stay as they were.
void expect_no_room(const ScratchFolder& folder, const std::string& out, const std::string& reason, const Limits& limits) {
    std::string baked = make_baked(folder.path(), 257);
    for (const char* end : {".ovl", ".ply", ".glb", ".png"}) write_text(out + "/out" + end, "an older file");
    auto before = contents_of(folder.path());
    for (const Writing& writing : all_writing(folder / "sample/dem.tif", baked, out + "/out"))
        expect_refusal(run(writing.words, limits), 4, writing.name, {writing.words.back(), reason});
    EXPECT_EQ(contents_of(folder.path()), before);

    Ran sample = run({"make-sample", "dem", "--size", "257", "-o", out, "--quiet"}, limits);
    expect_refusal(sample, 4, "make-sample dem", {out + "/dem.tif", reason});
    EXPECT_EQ(contents_of(folder.path()), before);
}

TEST(UnwritableOutput, FileLargerThanTheLimit) {
    ScratchFolder folder;
    fs::create_directory(folder / "out");
    Limits limits;
    limits.file_bytes = 16384;
    expect_no_room(folder, folder / "out", "File too large", limits);
}

TEST(UnwritableOutput, FullDisk) {
    ScratchFolder folder;
    fs::create_directory(folder / "disk");
    if (!mount_small_disk(folder / "disk", "32k")) GTEST_SKIP() << "this system lets nobody mount a small disk for a test";
    expect_no_room(folder, folder / "disk", "No space left on device", {});
    unmount_small_disk(folder / "disk");
}

}  // namespace
}  // namespace overlook::cli
