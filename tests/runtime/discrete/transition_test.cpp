#include "runtime/discrete/transition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace overlook::discrete {
namespace {

constexpr double kFade_s = 0.25, kStep_s = 1.0 / 60;

TEST(TwoRamps, AlwaysKeepOneOfTheLevelsWhole) {
    for (double phase = 0; phase <= 1; phase += 1.0 / 64) {
        EXPECT_EQ(std::max(visible_share_of_new(phase), visible_share_of_old(phase)), 1);
        EXPECT_EQ(visible_share_of_new(phase), phase < 0.5 ? 2 * phase : 1);
        EXPECT_EQ(visible_share_of_old(phase), phase > 0.5 ? 2 - 2 * phase : 1);
    }
    EXPECT_EQ(visible_share_of_new(0), 0);
    EXPECT_EQ(visible_share_of_old(1), 0);
}

TEST(Easing, SetsOffAndComesToRestAtHalfThePaceOfItsMiddle) {
    EXPECT_EQ(eased(0), 0);
    EXPECT_EQ(eased(1), 1);
    EXPECT_NEAR(eased(0.5), 0.5, 1e-12);
    auto step_at = [](int frame) { return eased((frame + 1) / 8.0) - eased(frame / 8.0); };
    for (int frame = 1; frame < 7; ++frame) EXPECT_NEAR(step_at(frame), 1 / 7.0, 1e-12) << frame;
    EXPECT_NEAR(step_at(0), 1 / 14.0, 1e-12);
    EXPECT_NEAR(step_at(7), 1 / 14.0, 1e-12);
    for (double phase = 0; phase < 1; phase += 1.0 / 512) {
        EXPECT_LT(eased(phase), eased(phase + 1.0 / 512));
        EXPECT_NEAR(eased(1 - phase), 1 - eased(phase), 1e-12) << "one that turns back looks as before";
    }
}

TEST(Transition, RestsWhileNothingElseIsWanted) {
    Transition resting{3, 3, 0};
    EXPECT_EQ(step(resting, 3, 1, kFade_s, false), resting);
    EXPECT_EQ(visible_share(resting, 3), 1);
    EXPECT_EQ(visible_share(resting, 2), 0);
}

TEST(Transition, EndsInItsTimeWhateverTheSteps) {
    for (double dt_s : {kStep_s, 0.001, 0.1, 7 * kStep_s, 0.3}) {
        Transition now{0, 0, 0};
        double time_s = 0;
        do {
            now = step(now, 1, dt_s, kFade_s, false);
            time_s += dt_s;
        } while (!now.is_resting());
        EXPECT_EQ(now.to, 1u);
        EXPECT_LT(time_s, kFade_s + dt_s) << dt_s;
        EXPECT_GE(time_s, kFade_s * (1 - 1e-9)) << dt_s;
    }
}

TEST(Transition, StandsStillWithoutTime) {
    Transition now = step({0, 0, 0}, 1, kStep_s, kFade_s, false);
    EXPECT_EQ(step(now, 1, 0, kFade_s, false), now);
}

// Shares of both levels may change by no more than the ramp's slope allows, whatever is wanted when.
TEST(Transition, NeverJumpsWhateverIsWantedWhen) {
    std::mt19937 random(6);
    Transition now{2, 2, 0};
    const double most = 2 * kStep_s / kFade_s + 1e-9;
    for (int frame = 0; frame < 20000; ++frame) {
        uint32_t wanted = std::uniform_int_distribution<uint32_t>(0, 4)(random);
        Transition next = step(now, wanted, kStep_s, kFade_s, frame % 2 == 0);
        for (uint32_t level = 0; level < 5; ++level) {
            ASSERT_LE(std::abs(visible_share(next, level) - visible_share(now, level)), most) << frame << " level " << level;
        }
        now = next;
    }
}

TEST(Transition, TurnsBackWithBothSharesAsTheyWere) {
    Transition now{0, 0, 0};
    for (int i = 0; i < 5; ++i) now = step(now, 1, kStep_s, kFade_s, false);
    Transition turned = step(now, 0, 0, kFade_s, false);
    EXPECT_EQ(turned.from, 1u);
    EXPECT_EQ(turned.to, 0u);
    for (uint32_t level : {0u, 1u}) EXPECT_DOUBLE_EQ(visible_share(turned, level), visible_share(now, level));
    // And is back sooner than it came.
    double back_s = 0;
    for (; !turned.is_resting(); back_s += kStep_s) turned = step(turned, 0, kStep_s, kFade_s, false);
    EXPECT_EQ(turned.to, 0u);
    EXPECT_LE(back_s, 5 * kStep_s + 1e-9);
}

TEST(Transition, SkipsOrPassesTheLevelsBetween) {
    for (bool is_one_by_one : {false, true}) {
        Transition now{4, 4, 0};
        std::vector<uint32_t> rested;
        for (int frame = 0; frame < 200 && (rested.empty() || rested.back() != 0); ++frame) {
            now = step(now, 0, kStep_s, kFade_s, is_one_by_one);
            if (now.is_resting()) rested.push_back(now.to);
        }
        EXPECT_EQ(rested, is_one_by_one ? (std::vector<uint32_t>{3, 2, 1, 0}) : (std::vector<uint32_t>{0}));
    }
}

TEST(Transition, GoesToTheNearerEndBeforeItBeginsAnew) {
    Transition under_way{1, 4, 0.3};
    EXPECT_EQ(step(under_way, 3, 0, kFade_s, false), under_way);                // nearer to where it goes
    EXPECT_EQ(step(under_way, 2, 0, kFade_s, false), (Transition{4, 1, 0.7}));  // nearer to where it came from
    EXPECT_EQ(step(under_way, 9, 0, kFade_s, false), under_way);
    // One change at a time: arriving and beginning are two calls.
    Transition arrived = step({1, 4, 0.99}, 9, 10, kFade_s, false);
    EXPECT_EQ(arrived, (Transition{4, 4, 0}));
    EXPECT_EQ(step(arrived, 9, 0, kFade_s, false), (Transition{4, 9, 0}));
}

}  // namespace
}  // namespace overlook::discrete
