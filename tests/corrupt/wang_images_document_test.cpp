// That formats/spec/wang_ldi.md says of layered depth images what the code does.
#include <gtest/gtest.h>

#include "formats/wang_ldi_grouped.h"
#include "tests/corrupt/terrain_fixtures.h"
#include "tests/corrupt/wang_images_fixtures.h"
#include "tests/formats/scratch_folder.h"

namespace overlook::wang_ldi::image_fixtures {
namespace {

std::string document() {
    return text_of_file(OVERLOOK_SOURCE_DIR "/formats/spec/wang_ldi.md");
}

TEST(ImagesDocument, ShowsTheVeryBytesOfTheExamplesDirectory) {
    std::string text = document();
    size_t at = text.find("## WLDI of the example");
    ASSERT_NE(at, std::string::npos);
    Bytes documented = terrain::fixtures::bytes_of_hexdump(text.substr(at));
    Bytes made = bytes_of_head(post());
    EXPECT_TRUE(documented == made);
}

TEST(ImagesDocument, ShowsTheVeryBytesOfTheExamplesFirstImage) {
    std::string text = document();
    size_t at = text.find("## The first image of the example");
    ASSERT_NE(at, std::string::npos);
    Bytes documented = terrain::fixtures::bytes_of_hexdump(text.substr(at));
    EXPECT_TRUE(documented == bytes_of_ldi(post(), images_of_post()[0]));
}

TEST(ImagesDocument, ShowsTheVeryBytesOfTheSameImageGrouped) {
    std::string text = document();
    size_t at = text.find("## The same image, grouped");
    ASSERT_NE(at, std::string::npos);
    Bytes documented = terrain::fixtures::bytes_of_hexdump(text.substr(at));
    EXPECT_TRUE(documented == grouped_bytes_of(grouped_post(), 0, images_of_post()[0]).bytes);
}

TEST(ImagesDocument, HasTheSentenceOfEveryRule) {
    std::string text = document();
    for (int rule = 1; rule <= image_rule_count(); rule++) {
        std::string row = fmt::format("\n| L{} | {} |", rule, image_rule_text(rule));
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
    EXPECT_EQ(text.find(fmt::format("| L{} |", image_rule_count() + 1)), std::string::npos);
    EXPECT_EQ(image_rule_text(0), "");
    EXPECT_EQ(image_rule_text(image_rule_count() + 1), "");
}

}  // namespace
}  // namespace overlook::wang_ldi::image_fixtures
