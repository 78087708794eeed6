// Parallax between a frame and a key, on cameras whose answer is known, and what is counted by it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/measure/numbers/parallax.h"

namespace overlook::measure {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

// Looks north, a wall 100 m away that fills the picture; its focal length is half its side.
Frame wall(uint32_t side_px) {
    Frame frame;
    frame.width = frame.height = frame.camera.width_px = frame.camera.height_px = side_px;
    frame.camera.fov_y_deg = 90;
    frame.depth_m.assign(size_t(side_px) * side_px, 100);
    return frame;
}

TEST(Parallax, OfAKeyBesideIsTheSameAllOverAWall) {
    Frame frame = wall(64);
    view::Camera key = frame.camera;
    key.position_m.x += 10;
    for (float parallax : parallax_px(frame, key)) EXPECT_NEAR(parallax, 32 * 10 / 100.0, 1e-4);
    key.position_m.z += 10;
    for (float parallax : parallax_px(frame, key)) EXPECT_NEAR(parallax, 3.2 * std::sqrt(2), 1e-4);
}

TEST(Parallax, GrowsAsTheSurfaceIsNearer) {
    Frame frame = wall(64);
    frame.depth_m[5] = 10;
    view::Camera key = frame.camera;
    key.position_m.x += 10;
    EXPECT_NEAR(parallax_px(frame, key)[5], 32, 1e-3);
}

TEST(Parallax, OfAKeyBehindGrowsFromTheMiddleOutwards) {
    Frame frame = wall(64);
    view::Camera key = frame.camera;
    key.position_m.y -= 25;  // the wall is 125 m from it: what is r px from the middle was 0.8 r
    std::vector<float> parallax = parallax_px(frame, key);
    double corner_px = 31.5 * std::sqrt(2);
    EXPECT_NEAR(parallax[0], 0.2 * corner_px, 1e-3);
    EXPECT_NEAR(parallax[31 * 64 + 31], 0.2 * 0.5 * std::sqrt(2), 1e-3);
}

TEST(Parallax, IsNotInTurningNorInTheKeysOwnLens) {
    Frame frame = wall(64);
    view::Camera key = frame.camera;
    key.heading_deg = 70;
    key.pitch_deg = -30;
    key.fov_y_deg = 40;
    key.width_px = key.height_px = 999;
    for (float parallax : parallax_px(frame, key)) EXPECT_NEAR(parallax, 0, 1e-6);
    key.position_m.x += 10;
    for (float parallax : parallax_px(frame, key)) EXPECT_NEAR(parallax, 3.2, 1e-4);
}

TEST(Parallax, IsNothingOfTheSkyAndInfiniteOfWhatTheKeyHasBehindItsBack) {
    Frame frame = wall(8);
    frame.depth_m[0] = kNothing;
    view::Camera key = frame.camera;
    key.position_m.y += 200;  // past the wall
    std::vector<float> parallax = parallax_px(frame, key);
    EXPECT_TRUE(std::isnan(parallax[0]));
    EXPECT_TRUE(std::isinf(parallax[1]));
}

TEST(ParallaxTally, PutsAPixelIntoTheRangeThatItsParallaxBegins) {
    ParallaxTally tally;
    tally.add(
        std::vector<float>{0, 0.999f, 1, 31.9f, 32, 64, kNothing},
        std::vector<Reused>{Reused::well, Reused::ghost, Reused::loss, Reused::well, Reused::ghost, Reused::loss, Reused::near});
    std::span<const ParallaxBin> bins = tally.bins();
    ASSERT_EQ(bins.size(), 8u);
    EXPECT_EQ(bins[0].asked_px, 2u);
    EXPECT_EQ(bins[0].ghosts_px, 1u);
    EXPECT_EQ(bins[1].losses_px, 1u);
    EXPECT_EQ(bins[5].asked_px, 1u);
    EXPECT_EQ(bins[6].ghosts_px, 1u);
    EXPECT_EQ(bins[7].losses_px, 1u);
    EXPECT_EQ(bins[7].near_px, 1u);
    EXPECT_EQ(bins[7].asked_px, 1u) << "near geometry is not asked of any key";
}

TEST(ParallaxTally, SumsFramesAndTheRangesBelowAnEdge) {
    ParallaxTally tally;
    std::vector<float> parallax = {0.5f, 3, 40, std::numeric_limits<float>::quiet_NaN()};
    for (int frame = 0; frame < 2; ++frame)
        tally.add(parallax, std::vector<Reused>{Reused::well, Reused::ghost, Reused::loss, Reused::nothing_there});
    ParallaxBin below = tally.up_to(32);
    EXPECT_EQ(below.asked_px, 4u);
    EXPECT_EQ(below.ghost_share(), 0.5);
    EXPECT_EQ(below.loss_share(), 0) << "what lies beyond is not in it";
    EXPECT_EQ(tally.up_to(64).loss_share(), 2.0 / 6);
    EXPECT_EQ(ParallaxTally().up_to(32).ghost_share(), 0);
}

}  // namespace
}  // namespace overlook::measure
