// That formats/spec/terrain.md says what the code does.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/corrupt/terrain_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::terrain::fixtures {
namespace {

std::string document() {
    return text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/terrain.md");
}

TEST(TerrainDocument, ShowsTheVeryBytesThatTheWriterWrites) {
    Bytes documented = bytes_of_hexdump(document());
    ScratchFolder folder;
    Result<container::Writer> writer = container::Writer::create(folder / "hill.ovl", kKind);
    ASSERT_TRUE(writer) << writer.error().message;
    ASSERT_TRUE(write(*writer, hill()));
    ASSERT_TRUE(writer->commit());
    std::string written = text_of_file(folder / "hill.ovl");
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(written)), documented));
    EXPECT_TRUE(std::ranges::equal(file_of(hill()), documented));

    Result<container::Reader> file = container::Reader::open_bytes(documented, "terrain.md");
    ASSERT_TRUE(file) << file.error().message;
    Result<Terrain> terrain = read(*file);
    ASSERT_TRUE(terrain) << terrain.error().message;
    EXPECT_EQ(terrain->heights, (std::vector<int32_t>{100, 101, 102, 103, 110, 105, 106, 107, 108}));
    EXPECT_EQ(terrain->codes, (std::vector<std::vector<uint8_t>>{{0, 0, 0, 0, 1, 0, 0, 0, 0}}));
    EXPECT_EQ(terrain->error_m[1], 6);
}

TEST(TerrainDocument, HasTheSentenceOfEveryRule) {
    std::string text = document();
    for (int rule = 1; rule <= rule_count(); rule++) {
        std::string row = fmt::format("\n| T{} | {} |", rule, rule_text(rule));
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(text.find(fmt::format("| T{} |", rule_count() + 1)), std::string::npos);
    EXPECT_EQ(rule_text(0), "");
    EXPECT_EQ(rule_text(rule_count() + 1), "");
}

}  // namespace
}  // namespace overlook::terrain::fixtures
