#include "formats/mapped_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "formats/atomic_file.h"
#include "tests/formats/scratch_folder.h"

namespace overlook {
namespace {

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(MappedFile, HoldsTheBytesEvenWhenTheFileIsReplaced) {
    ScratchFolder folder;
    ASSERT_TRUE(write_file(folder / "a", "old"));
    Result<MappedFile> file = MappedFile::open(folder / "a");
    ASSERT_TRUE(file);
    ASSERT_TRUE(write_file(folder / "a", "new and longer"));
    EXPECT_EQ(text_of(file->bytes()), "old");
    MappedFile moved = std::move(*file);
    EXPECT_EQ(text_of(moved.bytes()), "old");
    EXPECT_TRUE(file->bytes().empty());
}

TEST(MappedFile, OfNoBytesIsAnEmptySpan) {
    ScratchFolder folder;
    ASSERT_TRUE(write_file(folder / "a", ""));
    Result<MappedFile> file = MappedFile::open(folder / "a");
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->bytes().empty());
}

TEST(MappedFile, SaysWhatCannotBeMapped) {
    ScratchFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    auto message = [](const std::string& path) {
        Result<MappedFile> file = MappedFile::open(path);
        return file || file.error().exit != Exit::bad_input ? "" : file.error().message;
    };
    EXPECT_EQ(message(folder / "none"), folder.path() + "/none: No such file or directory");
    EXPECT_EQ(message(folder.path()), folder.path() + ": is a folder; give a file");
    std::string not_regular = ": is not a regular file, so it cannot be mapped; copy it into a file first";
    EXPECT_EQ(message(folder / "pipe"), folder.path() + "/pipe" + not_regular);
    EXPECT_EQ(message("/dev/null"), "/dev/null" + not_regular);
}

// The published value for no bytes, which xxh128sum prints too: high half first.
TEST(ContentHash, IsXxh3Of128BitsInItsCanonicalOrder) {
    EXPECT_EQ(content_hash({}), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentHash, IsOfEveryByte) {
    std::string_view text = "valley";
    auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    EXPECT_NE(content_hash(bytes), content_hash(bytes.first(5)));
    EXPECT_EQ(content_hash(bytes).size(), 32u);
}

}  // namespace
}  // namespace overlook
