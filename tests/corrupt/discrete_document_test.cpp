// That formats/spec/discrete.md says what the code does.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/corrupt/discrete_fixtures.h"
#include "tests/corrupt/terrain_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::discrete::fixtures {
namespace {

std::string document() {
    return text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/discrete.md");
}

TEST(ChainDocument, ShowsTheVeryBytesThatTheWriterWrites) {
    Bytes documented = terrain::fixtures::bytes_of_hexdump(document());
    ScratchFolder folder;
    auto writer = container::Writer::create(folder / "pyramid.ovl", kKind);
    ASSERT_TRUE(writer) << writer.error().message;
    ASSERT_TRUE(write(*writer, pyramid()));
    ASSERT_TRUE(writer->commit());
    std::string written = text_of_file(folder / "pyramid.ovl");
    EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(written)), documented));

    Result<container::Reader> file = container::Reader::open_bytes(documented, "discrete.md");
    ASSERT_TRUE(file) << file.error().message;
    Result<Chain> chain = read(*file);
    ASSERT_TRUE(chain) << chain.error().message;
    ASSERT_EQ(chain->levels.size(), 2u);
    EXPECT_EQ(chain->levels[0].vertices, pyramid().levels[0].vertices);
    EXPECT_EQ(chain->levels[1].error_m, 4);
    EXPECT_EQ(chain->parts, pyramid().parts);
    EXPECT_EQ(chain->visibility, pyramid().visibility);
}

TEST(ChainDocument, HasTheSentenceOfEveryRule) {
    std::string text = document();
    for (int rule = 1; rule <= rule_count(); rule++) {
        std::string row = fmt::format("\n| D{} | {} |", rule, rule_text(rule));
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(text.find(fmt::format("| D{} |", rule_count() + 1)), std::string::npos);
    EXPECT_EQ(rule_text(0), "");
    EXPECT_EQ(rule_text(rule_count() + 1), "");
}

}  // namespace
}  // namespace overlook::discrete::fixtures
