// Budgets whose cost is counted before a frame is drawn.
#include "runtime/view/counted_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace overlook::view {
namespace {

using Cost = std::function<double(double)>;

// A frame: what it costs at the error found, which is what was counted last.
struct Frame {
    double error_px = 0, cost = 0;
    int counts = 0;
};
Frame frame_of(CountedError& fitting, double least_error_px, const Cost& cost) {
    Frame frame;
    double last_px = 0;
    int counts = 0;
    frame.error_px = fitting.error_px(least_error_px, [&](double error_px) {
        ++counts, last_px = error_px;
        EXPECT_GE(error_px, least_error_px);
        EXPECT_LE(error_px, std::max(256.0001, least_error_px));
        return cost(error_px);
    });
    EXPECT_EQ(last_px, frame.error_px) << "what was counted last is what is drawn";
    EXPECT_EQ(counts, fitting.count_count());
    EXPECT_LE(counts, 24);
    frame.cost = cost(frame.error_px), frame.counts = counts;
    return frame;
}

TEST(CountedError, WithoutABudgetOrWithOneOfMoreAsksForTheLeast) {
    Cost cost = [](double error_px) { return 1000 / error_px; };
    for (double most : {0.0, 2000.0, 1e18}) {
        CountedError fitting;
        fitting.set_most(most);
        for (double least_px : {0.5, 1.0, 300.0}) {
            Frame frame = frame_of(fitting, least_px, cost);
            EXPECT_EQ(frame.error_px, least_px) << most;
            EXPECT_EQ(frame.counts, 1);
        }
    }
}

// Powers, and one that hardly falls and then at once, in the first frame after the budget changed.
TEST(CountedError, KeepsABudgetInTheFirstFrameAndRestsInTheNext) {
    const std::vector<Cost> costs = {[](double e) { return 1e6 / e; }, [](double e) { return 1e6 / (e * e); },
                                     [](double e) { return 1e6 / std::sqrt(e); },
                                     [](double e) { return 1e6 / (1 + std::exp(8 * std::log(e / 20))); }};
    for (size_t c = 0; c < costs.size(); ++c) {
        CountedError fitting;
        for (double most : {9e5, 4.5e5, 1e5, 7e4, 8e5, 3e5}) {
            fitting.set_most(most);
            Frame frame = frame_of(fitting, 1, costs[c]);
            EXPECT_LE(frame.cost, most) << c;
            EXPECT_GE(frame.cost, 0.95 * most) << c;
            Frame next = frame_of(fitting, 1, costs[c]);
            EXPECT_EQ(next.error_px, frame.error_px);
            EXPECT_EQ(next.counts, 1) << c << " of " << most;
        }
        fitting.set_most(0);
        EXPECT_EQ(frame_of(fitting, 1, costs[c]).error_px, 1);
    }
}

// What a moving camera changes from frame to frame: never more than the budget, and seldom counted twice.
TEST(CountedError, NeverCostsMoreWhileTheCostGoesUpAndDown) {
    CountedError fitting;
    fitting.set_most(5e5);
    int counts = 0;
    for (int f = 0; f < 400; ++f) {
        double times = 1.5 + 0.4 * std::sin(0.05 * f) + 0.1 * std::sin(1.3 * f);
        Frame frame = frame_of(fitting, 1, [&](double e) { return times * 1e6 / e; });
        EXPECT_LE(frame.cost, 5e5) << f;
        EXPECT_GE(frame.cost, 4.75e5) << f;
        counts += frame.counts;
    }
    EXPECT_LT(counts, 4 * 400);
}

TEST(CountedError, StandsBesideAJumpWithoutSearchingAgain) {
    Cost cost = [](double e) { return e < 7.3 ? 1000.0 : 100.0; };
    CountedError fitting;
    fitting.set_most(500);
    Frame frame = frame_of(fitting, 1, cost);
    EXPECT_EQ(frame.cost, 100);
    EXPECT_NEAR(frame.error_px, 7.3, 0.01);
    for (int f = 0; f < 5; ++f) {
        Frame next = frame_of(fitting, 1, cost);
        EXPECT_EQ(next.error_px, frame.error_px);
        EXPECT_EQ(next.counts, 3);
    }
    // The jump moves away.
    Frame moved = frame_of(fitting, 1, [](double e) { return e < 5 ? 1000.0 : 100.0; });
    EXPECT_NEAR(moved.error_px, 5, 0.01);
}

// A level that gives way to another costs more before it costs less: beyond that bump there is room again.
TEST(CountedError, LooksBeyondABumpForWhatKeepsItCloser) {
    Cost cost = [](double e) { return e < 7 ? 6700 / e : e < 7.4 ? 1010.0 : e < 7.5 ? 1040.0 : 900.0; };
    CountedError fitting;
    fitting.set_most(1005);
    for (double from_px : {1.0, 7.6, 20.0}) {
        frame_of(fitting, from_px, [](double) { return 980.0; });  // rests there
        EXPECT_LE(frame_of(fitting, 1, cost).cost, 1005) << from_px;
        Frame frame = frame_of(fitting, 1, cost);
        EXPECT_LE(frame.cost, 1005) << from_px;
        EXPECT_GE(frame.cost, 0.95 * 1005) << from_px;
    }
    // None where the bump is wider, or too high to go on.
    for (double high : {1010.0, 1200.0}) {
        Cost wide = [&](double e) { return e < 5 ? 5000 / e : e < 7.5 ? high : 900.0; };
        CountedError other;
        other.set_most(1005);
        frame_of(other, 7.6, [](double) { return 980.0; });
        Frame frame = frame_of(other, 1, wide);
        EXPECT_EQ(frame.cost, 900) << high;
        EXPECT_LE(frame.counts, 24);
        Frame next = frame_of(other, 1, wide), last = frame_of(other, 1, wide);
        EXPECT_LE(next.counts, high > 1100 ? 3 : 17);
        EXPECT_EQ(last.counts, 3);  // not looked for again
        EXPECT_EQ(last.cost, 900);
    }
}

// Plants that come and go at once leave room that the ground takes up.
TEST(CountedError, FillsWhatIsLeftOverByAnotherPart) {
    CountedError budget;
    auto filled = [&](double plants, double ground_at_1_px, double finest_px, double error_px) {
        auto cost_at = [&](double px) { return plants + ground_at_1_px / px; };
        double last_px = 0;
        double found = budget.filled_px(finest_px, error_px, cost_at(error_px), [&](double px) {
            EXPECT_GE(px, finest_px);
            EXPECT_LE(px, error_px);
            return cost_at(last_px = px);
        });
        if (last_px > 0) {
            EXPECT_EQ(found, last_px) << "what was counted last is what is drawn";
        }
        return std::pair(found, cost_at(found));
    };
    EXPECT_EQ(filled(900, 100, 1, 4).first, 4);  // without a budget nothing is
    budget.set_most(1000);
    auto [much_px, much] = filled(900, 100, 1, 4);  // 925 to 1,000: as little as reaches 960
    EXPECT_GE(much, 960);
    EXPECT_LT(much, 961);
    EXPECT_NEAR(much_px, 100.0 / 60, 0.02);
    EXPECT_EQ(filled(853, 100, 1, 4).first, 1);  // 953 at its finest
    EXPECT_EQ(filled(845, 100, 1, 4).first, 4);  // 945: not worth it
    EXPECT_EQ(filled(930, 100, 1, 4).first, 4);  // 955 as it is
    EXPECT_EQ(filled(100, 100, 1, 1).first, 1);
    // At once from too little to too much: neither.
    auto jump = [](double px) { return px < 2 ? 1100.0 : 900.0; };
    EXPECT_EQ(budget.filled_px(1, 4, 900, jump), 4);
}

TEST(CountedError, ThatCannotKeepItAsksForTheGreatestErrorAndCountsOnce) {
    Cost cost = [](double e) { return 1e6 / e + 5000; };
    CountedError fitting;
    fitting.set_most(1000);
    EXPECT_NEAR(frame_of(fitting, 1, cost).error_px, 256, 0.01);
    Frame next = frame_of(fitting, 1, cost);
    EXPECT_NEAR(next.error_px, 256, 0.01);
    EXPECT_EQ(next.counts, 1);
    fitting.set_most(1e5);
    Frame again = frame_of(fitting, 1, cost);
    EXPECT_LE(again.cost, 1e5);
    EXPECT_GE(again.cost, 9.5e4);
    fitting.set_most(1e-9);
    frame_of(fitting, 1, [](double) { return 0.0; });
    frame_of(fitting, 400, cost);
}

// Costs that go up a little here and there, as levels give way to others.
TEST(CountedError, KeepsItThoughTheCostDoesNotAlwaysFall) {
    Cost cost = [](double e) { return 1e6 / e * (1 + 0.06 * std::sin(40 * std::log(e))); };
    CountedError fitting;
    for (double most : {8e5, 4e5, 2e5, 6e5, 5e4, 9e5}) {
        fitting.set_most(most);
        Frame frame = frame_of(fitting, 1, cost);
        EXPECT_LE(frame.cost, most);
        EXPECT_GE(frame.cost, 0.95 * most);
    }
}

}  // namespace
}  // namespace overlook::view
