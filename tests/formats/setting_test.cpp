#include "formats/setting.h"

#include <gtest/gtest.h>

#include <array>

namespace overlook {
namespace {

constexpr std::array<std::string_view, 3> kWords = {"left", "middle", "right-most"};
constexpr SettingKind kNumber{"share", 0, 1, 0.5};
constexpr SettingKind kChosen{"side", 0, 2, 1, true, true, false, kWords};

TEST(Setting, IsReadAndWrittenByItsWords) {
    for (size_t i = 0; i < kWords.size(); ++i) {
        EXPECT_EQ(value_of_word(kChosen, kWords[i]), double(i));
        EXPECT_EQ(text_of(kChosen, double(i)), kWords[i]);
    }
    for (std::string_view word : {"", "lef", "left ", "1", "Left"}) EXPECT_EQ(value_of_word(kChosen, word), std::nullopt) << word;
    EXPECT_EQ(listed_words(kChosen), "left, middle or right-most");
}

TEST(Setting, OfNumbersHasNoWords) {
    EXPECT_EQ(text_of(kNumber, 0.25), "0.25");
    EXPECT_EQ(text_of(kNumber, 1), "1");
    EXPECT_EQ(value_of_word(kNumber, "0.25"), std::nullopt);
}

}  // namespace
}  // namespace overlook
