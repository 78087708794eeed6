#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "tests/tools/numbers_pictures.h"
#include "tools/measure/numbers/frame_subset.h"
#include "tools/measure/numbers/frame_times.h"
#include "tools/measure/numbers/honesty_tally.h"
#include "tools/measure/numbers/image_reuse.h"
#include "tools/measure/numbers/path_dependence.h"

namespace overlook::measure {
namespace {

std::vector<double> one_to(int count) {
    std::vector<double> values(size_t(count), 0.0);
    std::iota(values.rbegin(), values.rend(), 1.0);  // descending: the order must not matter
    return values;
}

TEST(Percentile, IsTheSmallestValueThatTheShareDoesNotExceed) {
    for (int count : {20, 100, 600}) {
        Percentiles all = percentiles_of(one_to(count));
        EXPECT_EQ(all.p50, count / 2);
        EXPECT_EQ(all.p95, count * 95 / 100);
        EXPECT_EQ(all.p99, std::ceil(count * 99 / 100.0));
        EXPECT_EQ(all.max, count);
        EXPECT_EQ(percentile(std::span<const double>(one_to(count)), 0.95), all.p95);
    }
    EXPECT_EQ(percentiles_of(one_to(5)).p50, 3);
    EXPECT_EQ(percentile(std::span<const double>(one_to(9)), 0), 1);
    EXPECT_EQ(percentile(std::span<const double>(one_to(9)), 1), 9);
}

TEST(Percentile, OfOneValueIsItAndOfNoneIsNothing) {
    Percentiles one = percentiles_of(std::vector<double>{7});
    EXPECT_EQ(one.p50, 7);
    EXPECT_EQ(one.p99, 7);
    EXPECT_EQ(one.max, 7);
    EXPECT_EQ(percentiles_of({}).max, 0);
    EXPECT_EQ(percentile(std::span<const float>(), 0.5), 0);
}

TEST(FrameTimes, CountMissedDeadlinesAndTheirLongestRun) {
    std::vector<double> ms = {10, 17, 20, 16.7, 40, 34, 33.4, 5, 18};
    FrameTimes times = frame_times_of(ms);
    EXPECT_EQ(times.missed_60.count, 6u);
    EXPECT_EQ(times.missed_60.longest_run, 3u);
    EXPECT_EQ(times.missed_30.count, 3u);
    EXPECT_EQ(times.missed_30.longest_run, 3u);
    EXPECT_EQ(times.ms.p50, 18);
    EXPECT_EQ(times.ms.max, 40);
    EXPECT_EQ(frame_times_of({}).missed_60.count, 0u);
}

TEST(FrameTimes, ShowTheStallsThatAMeanHides) {
    // 600 frames of 2 ms, of which 16 take 680 ms: 20 ms in the mean, against a steady 30 ms.
    std::vector<double> keyframes(600, 2.0), steady(600, 30.0);
    for (size_t i = 0; i < 16; ++i) keyframes[i * 37] = 680;
    FrameTimes stalling = frame_times_of(keyframes), even = frame_times_of(steady);
    EXPECT_LT(std::accumulate(keyframes.begin(), keyframes.end(), 0.0), std::accumulate(steady.begin(), steady.end(), 0.0));
    EXPECT_GT(stalling.ms.p99, even.ms.p99);
    EXPECT_EQ(stalling.missed_30.count, 16u);
    EXPECT_EQ(stalling.missed_30.longest_run, 1u);
    EXPECT_EQ(even.missed_30.count, 0u);
}

TEST(FrameSubset, TakesEveryTenthAndThreeRoundEachEvent) {
    std::vector<uint32_t> events = {25, 0, 39, 25, 44, 99};
    EXPECT_EQ(flip_frames(45, events), (std::vector<uint32_t>{0, 1, 10, 20, 24, 25, 26, 30, 38, 39, 40, 43, 44}));
    EXPECT_EQ(flip_frames(0, events).size(), 0u);
    EXPECT_EQ(flip_frames(600, {}).size(), 60u);
}

TEST(Honesty, SummarisesRatios) {
    std::vector<float> predicted = {1, 2, 4, 0, 1}, measured = {0.5f, 1.5f, 1, 0, 0.25f};
    Honesty honesty = honesty_of(predicted, measured);
    EXPECT_EQ(honesty.count, 5u);
    EXPECT_EQ(honesty.exact, 1u);
    EXPECT_EQ(honesty.above_prediction, 0u);
    EXPECT_EQ(honesty.ratio_max, 0.75);
    EXPECT_EQ(honesty.ratio_median, 0.25);
    EXPECT_EQ(honesty.measured_max_px, 1.5);
    EXPECT_EQ(honesty.predicted_max_px, 4);
}

TEST(Honesty, FailsItsGateOnASingleTriangleAboveItsPrediction) {
    std::vector<float> predicted(1000, 1), measured(1000, 0.5f);
    EXPECT_TRUE(is_honest(honesty_of(predicted, measured)));
    measured[700] = 1.01f;
    EXPECT_EQ(honesty_of(predicted, measured).above_prediction, 1u);
    EXPECT_FALSE(is_honest(honesty_of(predicted, measured)));
}

TEST(Honesty, FailsItsGateWhenNothingWasPromisedAndSomethingMeasured) {
    std::vector<float> predicted = {1, 0, 1}, measured = {1, 0.001f, 1};
    Honesty honesty = honesty_of(predicted, measured);
    EXPECT_EQ(honesty.broken_zeros, 1u);
    EXPECT_TRUE(std::isinf(honesty.ratio_max));
    EXPECT_FALSE(is_honest(honesty));
    measured[1] = 1e-9f;
    EXPECT_TRUE(is_honest(honesty_of(predicted, measured)));
}

TEST(Honesty, FailsItsGateWhenPredictionsAreIdle) {
    std::vector<float> predicted(9, 1), measured(9, 0.29f);
    EXPECT_FALSE(is_honest(honesty_of(predicted, measured)));
    for (float& px : measured) px = 0.31f;
    EXPECT_TRUE(is_honest(honesty_of(predicted, measured)));
}

TEST(Honesty, OfNothingOrOfExactTrianglesAloneIsKept) {
    EXPECT_TRUE(is_honest(honesty_of({}, {})));
    std::vector<float> nothing(4, 0);
    EXPECT_TRUE(is_honest(honesty_of(nothing, nothing)));
}

TEST(Honesty, CallsWhatIsNoNumberDishonest) {
    float none = std::numeric_limits<float>::quiet_NaN();
    for (auto [predicted, measured] : {std::pair(none, 1.0f), {1.0f, none}, {0.0f, none}, {-1.0f, 1.0f}})
        EXPECT_FALSE(is_honest(honesty_of(std::vector<float>{predicted}, std::vector<float>{measured})));
}

TEST(FrameSubset, SpreadsFromTheFirstToTheLast) {
    EXPECT_EQ(spread_frames(97, 4), (std::vector<uint32_t>{0, 32, 64, 96}));
    EXPECT_EQ(spread_frames(3, 12), (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_EQ(spread_frames(1, 12), (std::vector<uint32_t>{0}));
    EXPECT_EQ(spread_frames(0, 12).size(), 0u);
    EXPECT_EQ(spread_frames(600, 12).back(), 599u);
}

// Many promises between 2^-12 and 2^12 pixels, every kind of ratio among them.
void add_promises(uint64_t seed, std::vector<float>& predicted, std::vector<float>& measured) {
    for (uint64_t i = 0; i < 4000; ++i) {
        double share = double((i * 2654435761u + seed * 40503u) % 100003) / 100003;
        predicted.push_back(i % 50 == 0 ? 0 : float(std::exp2(24 * share - 12)));
        measured.push_back(predicted.back() * float(1.05 * share * share));
    }
}

TEST(HonestyTally, SaysWhatHonestySaysOfAllAtOnce) {
    std::vector<float> predicted, measured;
    HonestyTally whole, halves, other;
    for (uint64_t seed : {1, 2}) {
        std::vector<float> predicted_here, measured_here;
        add_promises(seed, predicted_here, measured_here);
        Honesty here = whole.add(predicted_here, measured_here);
        EXPECT_EQ(here.ratio_median, honesty_of(predicted_here, measured_here).ratio_median);
        (seed == 1 ? halves : other).add(predicted_here, measured_here);
        predicted.insert(predicted.end(), predicted_here.begin(), predicted_here.end());
        measured.insert(measured.end(), measured_here.begin(), measured_here.end());
    }
    halves.add(other);
    Honesty truth = honesty_of(predicted, measured);
    ASSERT_GT(truth.above_prediction, 0u);
    for (const HonestyTally* tally : {&whole, &halves}) {
        EXPECT_EQ(tally->all().count, truth.count);
        EXPECT_EQ(tally->all().above_prediction, truth.above_prediction);
        EXPECT_EQ(tally->all().exact, truth.exact);
        EXPECT_EQ(tally->all().ratio_max, truth.ratio_max);
        EXPECT_EQ(tally->all().measured_max_px, truth.measured_max_px);
        EXPECT_EQ(tally->all().predicted_max_px, truth.predicted_max_px);
        EXPECT_LE(tally->all().ratio_median, truth.ratio_median);
        EXPECT_GT(tally->all().ratio_median, truth.ratio_median - 1.0 / 1024);
    }
}

TEST(HonestyTally, SortsByWhatWasPredicted) {
    HonestyTally tally;
    tally.add(std::vector<float>{1, 1, 1.1f, 3000, 0.0001f, 0}, std::vector<float>{0.5f, 0.25f, 1.65f, 300, 0, 0});
    std::vector<HonestyBin> bins = tally.bins();
    ASSERT_EQ(bins.size(), 3u);
    EXPECT_EQ(bins[0].from_px, 0);
    EXPECT_EQ(bins[0].count, 1u);
    EXPECT_EQ(bins[1].from_px, 1);
    EXPECT_NEAR(bins[1].to_px, std::exp2(0.25), 1e-12);
    EXPECT_EQ(bins[1].count, 3u);
    EXPECT_EQ(bins[1].ratio_median, 0.5);
    EXPECT_NEAR(bins[1].ratio_p99, 1.5, 1e-6);
    EXPECT_EQ(bins[1].worst_px, 1.65f);
    EXPECT_EQ(bins[1].worst_promised_px, 1.1f);
    EXPECT_TRUE(std::isinf(bins[2].to_px));
}

TEST(HonestyTally, CallsWhatIsNoNumberDishonest) {
    float none = std::numeric_limits<float>::quiet_NaN();
    for (auto [predicted, measured] : {std::pair(none, 1.0f), {1.0f, none}, {0.0f, none}, {-1.0f, 1.0f}}) {
        HonestyTally tally;
        tally.add(std::vector<float>{predicted}, std::vector<float>{measured});
        EXPECT_FALSE(is_honest(tally.all()));
    }
}

TEST(PathDependence, IsTheMeanOfGreyLevels) {
    Picture forwards = noise_picture(40, 30, 3), plain = plain_picture(40, 30, 100, 100, 100);
    EXPECT_EQ(path_difference_grey(forwards, forwards), 0);
    EXPECT_DOUBLE_EQ(path_difference_grey(plain, plain_picture(40, 30, 103, 100, 94)), 3);
}

TEST(PathDependence, FailsItsGateOnAPatchThatStayedCoarse) {
    Picture forwards = plain_picture(64, 64, 100, 100, 100);
    Picture backwards = grey_picture(64, 64, [](uint32_t x, uint32_t y) { return x < 32 && y < 32 ? 108 : 100; });
    EXPECT_GT(path_difference_grey(forwards, backwards), 1);
    EXPECT_LE(path_difference_grey(forwards, plain_picture(64, 64, 101, 101, 101)), 1);
}

TEST(Switches, AreCountedPerThingAndAfterTheFirstSecond) {
    // Three things over six frames: the first flickers, the second changes once, the third never.
    std::vector<uint32_t> choices = {1, 5, 9, 2, 5, 9, 1, 6, 9, 2, 6, 9, 1, 6, 9, 1, 6, 9};
    Switches all = switches_of(choices, 3);
    EXPECT_EQ(all.count, 5u);
    EXPECT_EQ(all.greatest_of_thing, 4u);
    EXPECT_EQ(all.last_frame, 4u);
    EXPECT_EQ(switches_of(choices, 3, 4).count, 1u);
    EXPECT_EQ(switches_of(choices, 3, 5).count, 0u);
    EXPECT_EQ(switches_of({}, 3).count, 0u);
}

TEST(ImageReuse, TellsGhostsFromLosses) {
    std::vector<uint8_t> surface(1000, 1), used(1000, 1), visible(1000, 1);
    EXPECT_EQ(reuse_errors(surface, used, visible).ghost_share, 0);
    EXPECT_EQ(reuse_errors(surface, used, visible).loss_share, 0);
    for (size_t i = 0; i < 3; ++i) visible[i] = 0;  // used though hidden
    for (size_t i = 10; i < 26; ++i) used[i] = 0;   // not used though visible
    for (size_t i = 40; i < 50; ++i) used[i] = visible[i] = 0;
    ReuseErrors errors = reuse_errors(surface, used, visible);
    EXPECT_EQ(errors.ghosts_px, 3u);
    EXPECT_EQ(errors.losses_px, 16u);
    EXPECT_GT(errors.ghost_share, 0.002) << "the gates that these fail";
    EXPECT_GT(errors.loss_share, 0.015);
}

TEST(ImageReuse, DoesNotCountPixelsWithoutASurface) {
    std::vector<uint8_t> surface = {1, 1, 0, 0}, used = {1, 1, 1, 0}, visible = {1, 0, 0, 1};
    ReuseErrors errors = reuse_errors(surface, used, visible);
    EXPECT_EQ(errors.surface_px, 2u);
    EXPECT_EQ(errors.ghost_share, 0.5);
    EXPECT_EQ(errors.loss_share, 0);
    EXPECT_EQ(reuse_errors({}, {}, {}).ghost_share, 0);
}

}  // namespace
}  // namespace overlook::measure
