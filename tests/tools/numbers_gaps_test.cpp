// Gaps in what covers the ground.
#include <gtest/gtest.h>

#include "tools/measure/numbers/gaps.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kWidth = 12;

std::vector<uint8_t> covered(uint32_t rows = 10) {
    return std::vector<uint8_t>(size_t(kWidth) * rows, 1);
}
void open(std::vector<uint8_t>& mask, uint32_t x, uint32_t y, uint32_t wide, uint32_t high) {
    for (uint32_t j = y; j < y + high; ++j)
        for (uint32_t i = x; i < x + wide; ++i) mask[size_t(j) * kWidth + i] = 0;
}

TEST(Gaps, AreCountedByPixelsByTheirWidestSquareAndByTheLargestPiece) {
    std::vector<uint8_t> test = covered();
    EXPECT_EQ(gaps_of(covered(), test, kWidth).gap_px, 0u);
    open(test, 1, 1, 3, 2);   // a square of 2 fits
    open(test, 6, 0, 1, 9);   // a crack
    open(test, 11, 9, 1, 1);  // in the corner
    Gaps gaps = gaps_of(covered(), test, kWidth);
    EXPECT_EQ(gaps.covered_px, 120u);
    EXPECT_EQ(gaps.gap_px, 6u + 9 + 1);
    EXPECT_EQ(gaps.widest_px, 2u);
    EXPECT_EQ(gaps.largest_px, 9u);
    EXPECT_DOUBLE_EQ(gaps.share(), 16.0 / 120);
    open(test, 2, 3, 1, 1);  // touches the first
    open(test, 5, 2, 1, 1);  // touches the crack
    EXPECT_EQ(gaps_of(covered(), test, kWidth).largest_px, 10u);
    open(test, 3, 3, 3, 3);
    EXPECT_EQ(gaps_of(covered(), test, kWidth).widest_px, 3u);
}

TEST(Gaps, AreLookedForWhereTruthIsCoveredAllRoundAndWhereItIsAsked) {
    std::vector<uint8_t> truth = covered(), test = covered(), asked = covered();
    open(truth, 4, 4, 1, 1);
    open(test, 3, 3, 3, 3);  // the bare place and all that touch it: outlines, none of them a gap
    Gaps gaps = gaps_of(truth, test, kWidth);
    EXPECT_EQ(gaps.covered_px, 120u - 9);
    EXPECT_EQ(gaps.gap_px, 0u);
    open(test, 8, 7, 2, 1);
    EXPECT_EQ(gaps_of(truth, test, kWidth).gap_px, 2u);
    open(asked, 9, 0, 3, 10);
    gaps = gaps_of(truth, test, kWidth, asked);
    EXPECT_EQ(gaps.gap_px, 1u);
    EXPECT_EQ(gaps.covered_px, 90u - 9);
    gaps.add(gaps_of(truth, test, kWidth));
    EXPECT_EQ(gaps.gap_px, 3u);
    EXPECT_EQ(gaps.largest_px, 2u);
}

}  // namespace
}  // namespace overlook::measure
