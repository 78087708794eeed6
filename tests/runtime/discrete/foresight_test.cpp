#include "runtime/discrete/foresight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace overlook::discrete {
namespace {

constexpr double kStep_s = 1.0 / 60, kWindow_s = 0.25, kHorizon_s = 0.3;

TEST(Foresight, IsExactOfWhatMovesAndTurnsEvenly) {
    auto at = [](double time_s) {
        view::Camera camera;
        camera.position_m = {2 * time_s, 5 - 3 * time_s, 0.5 * time_s};
        camera.heading_deg = 350 + 40 * time_s - (350 + 40 * time_s > 360 ? 360 : 0), camera.pitch_deg = -8 * time_s;
        return camera;
    };
    Foresight foresight;
    for (int frame = 0; frame < 60; ++frame) {
        view::Camera now = at(frame * kStep_s), then = at(frame * kStep_s + kHorizon_s);
        view::Camera ahead = foresight.ahead(now, kStep_s, kWindow_s, kHorizon_s);
        const view::Camera& wanted = frame < 16 ? now : then;
        EXPECT_LT(glm::distance(ahead.position_m, wanted.position_m), 1e-9) << frame;
        EXPECT_NEAR(std::remainder(ahead.heading_deg - wanted.heading_deg, 360), 0, 1e-9) << frame;
        EXPECT_NEAR(ahead.pitch_deg, wanted.pitch_deg, 1e-9) << frame;
    }
}

// A camera that shakes by a step goes nowhere: what is foreseen of it lies within a few steps.
TEST(Foresight, DoesNotFollowAShake) {
    constexpr double kShake_m = 0.1;
    Foresight foresight;
    double farthest_m = 0;
    for (int frame = 0; frame < 60; ++frame) {
        view::Camera now;
        now.position_m.x = frame % 2 == 0 ? kShake_m : 0;
        farthest_m = std::max(farthest_m, std::abs(foresight.ahead(now, kStep_s, kWindow_s, kHorizon_s).position_m.x));
    }
    // By the last step alone it would be 2 * kHorizon_s / kStep_s shakes. The window's steps cancel but for one.
    EXPECT_LE(farthest_m, kShake_m * (1 + kHorizon_s / kWindow_s) + 1e-9);
}

TEST(Foresight, DoesNotFollowATeleport) {
    Foresight foresight;
    view::Camera now;
    for (int frame = 0; frame < 30; ++frame) {
        if (frame == 12) now.position_m.y += 1000;
        EXPECT_LT(glm::distance(foresight.ahead(now, kStep_s, kWindow_s, kHorizon_s).position_m, now.position_m), 1e-9) << frame;
    }
}

}  // namespace
}  // namespace overlook::discrete
