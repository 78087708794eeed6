#include "runtime/view/picture_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace overlook::view {
namespace {

TEST(PictureMask, IsTouchedWhereARectangleReachesAMarkedCell) {
    constexpr uint32_t kColumns = 11, kRows = 7;
    std::mt19937 random(5);
    std::vector<uint8_t> marked(kColumns * kRows);
    for (uint8_t& each : marked) each = random() % 9 == 0;
    PictureMask mask(kColumns, kRows, marked);
    EXPECT_EQ(mask.marked_count(), uint32_t(std::count(marked.begin(), marked.end(), 1)));
    auto share = [&] { return double(random() % 4096) / 2048 - 0.5; };
    uint32_t touched = 0, untouched = 0;
    for (int i = 0; i < 2000; ++i) {
        auto [left, right] = std::minmax({share(), share()});
        auto [top, bottom] = std::minmax({share(), share()});
        bool is_any = false;
        for (uint32_t y = 0; y < kRows; ++y)
            for (uint32_t x = 0; x < kColumns; ++x) {
                bool is_reached = (left < (x + 1.0) / kColumns || (left == 1 && x + 1 == kColumns)) &&
                                  right >= double(x) / kColumns && (top < (y + 1.0) / kRows || (top == 1 && y + 1 == kRows)) &&
                                  bottom >= double(y) / kRows;
                is_any |= is_reached && marked[y * kColumns + x] != 0;
            }
        EXPECT_EQ(mask.is_touched(left, right, top, bottom), is_any) << i;
        ++(is_any ? touched : untouched);
    }
    EXPECT_GT(touched, 100u);
    EXPECT_GT(untouched, 100u);
}

TEST(PictureMask, OfNothingIsTouchedNowhere) {
    EXPECT_TRUE(PictureMask().is_empty());
    EXPECT_FALSE(PictureMask().is_touched(0, 1, 0, 1));
    EXPECT_TRUE(PictureMask(2, 2, std::vector<uint8_t>(4)).is_empty());
}

}  // namespace
}  // namespace overlook::view
