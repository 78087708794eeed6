#include <gtest/gtest.h>

#include "tools/measure/numbers/trails.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kWidth = 24, kHeight = 8, kThing = 7, kRest = 3;

// Grey with a white bar of the moving thing, four pixels wide; the lower half is a thing at rest.
Frame frame_at(uint32_t left) {
    Frame frame;
    frame.width = kWidth, frame.height = kHeight;
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x) {
            bool is_bar = x >= left && x < left + 4;
            frame.ids.push_back(is_bar ? kThing : y < kHeight / 2 ? kBackground : kRest);
            for (int c = 0; c < 3; ++c) frame.rgb.push_back(is_bar ? 250 : y < kHeight / 2 ? 100 : 40);
        }
    return frame;
}
ImageRgb8 picture(const Frame& frame) {
    return {frame.width, frame.height, frame.rgb};
}
std::vector<uint8_t> only(uint32_t id) {
    std::vector<uint8_t> is_moving(kThing + 1);
    is_moving[id] = 1;
    return is_moving;
}

TEST(Trails, HaveNoGhostsInTheTruthAndAllOfThemInTheFrameBefore) {
    Frame before = frame_at(4), now = frame_at(10);
    std::vector<std::vector<uint32_t>> ids{before.ids};
    TrailErrors right = trail_errors(picture(now), now, ids, only(kThing), 1);
    EXPECT_EQ(right.trail_px, 4 * kHeight);
    EXPECT_EQ(right.ghost_px, 0u);
    TrailErrors late = trail_errors(picture(before), now, ids, only(kThing), 1);
    EXPECT_EQ(late.trail_px, 4 * kHeight);
    EXPECT_EQ(late.ghost_px, 4 * kHeight);
    EXPECT_EQ(late.is_ghost[4], 1);
    EXPECT_EQ(late.is_ghost[8], 0);
}

TEST(Trails, BeginBeyondTheMargin) {
    Frame before = frame_at(4), now = frame_at(6);
    std::vector<std::vector<uint32_t>> ids{before.ids};
    EXPECT_EQ(trail_errors(picture(now), now, ids, only(kThing), 0).trail_px, 2 * kHeight);
    EXPECT_EQ(trail_errors(picture(now), now, ids, only(kThing), 1).trail_px, 1 * kHeight);
    EXPECT_EQ(trail_errors(picture(now), now, ids, only(kThing), 2).trail_px, 0u);
}

// A faint rest of the thing counts as soon as it is more than so many greys off what may be there; what lies between the greys
// of the background and of the ground, one pixel from where they meet, does not.
TEST(Trails, CountFaintGhostsButNoBlendOfWhatIsThere) {
    Frame before = frame_at(4), now = frame_at(12);
    std::vector<std::vector<uint32_t>> ids{before.ids};
    auto ghosts_of = [&](uint32_t y, int grey) {
        ImageRgb8 test = picture(now);
        for (size_t c = 0; c < 3; ++c) test.pixels[3 * (y * kWidth + 5) + c] = uint8_t(grey);
        return trail_errors(test, now, ids, only(kThing), 1).ghost_px;
    };
    EXPECT_EQ(ghosts_of(0, 100 + kGhostGrey), 0u);
    EXPECT_EQ(ghosts_of(0, 100 + kGhostGrey + 1), 1u);
    EXPECT_EQ(ghosts_of(0, 100 - kGhostGrey - 1), 1u);
    EXPECT_EQ(ghosts_of(kHeight / 2, 70), 0u);
    EXPECT_EQ(ghosts_of(kHeight - 1, 70), 1u);
}

TEST(Trails, AreOfThingsThatMoveAlone) {
    Frame before = frame_at(4), now = frame_at(10);
    std::vector<std::vector<uint32_t>> ids{before.ids};
    EXPECT_EQ(trail_errors(picture(before), now, ids, only(1), 1).trail_px, 0u);
    EXPECT_EQ(trail_errors(picture(before), now, ids, {}, 1).trail_px, 0u);
    EXPECT_EQ(trail_errors(picture(before), now, {}, only(kThing), 1).trail_px, 0u);
}

}  // namespace
}  // namespace overlook::measure
