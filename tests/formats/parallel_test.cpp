#include "formats/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

namespace overlook {
namespace {

using Ranges = std::vector<std::pair<size_t, size_t>>;

Ranges sorted_ranges(size_t count, size_t grain) {
    Ranges ranges;
    std::mutex mutex;
    parallel_ranges(count, grain, [&](size_t begin, size_t end) {
        std::lock_guard lock(mutex);
        ranges.emplace_back(begin, end);
    });
    std::sort(ranges.begin(), ranges.end());
    return ranges;
}

TEST(ParallelRanges, CoverEverythingOnceInWholeGrains) {
    for (size_t count : {1u, 2u, 7u, 63u, 64u, 65u, 1000u}) {
        for (size_t grain : {1u, 3u, 64u, 5000u}) {
            size_t expected_begin = 0;
            for (auto [begin, end] : sorted_ranges(count, grain)) {
                EXPECT_EQ(begin, expected_begin);
                EXPECT_EQ(end, std::min(count, begin + grain));
                expected_begin = end;
            }
            EXPECT_EQ(expected_begin, count) << count << " by " << grain;
        }
    }
}

TEST(ParallelRanges, AreTheSameForEveryThreadCount) {
    set_thread_count(1);
    Ranges alone = sorted_ranges(1001, 10);
    for (unsigned threads : {2u, 3u, 8u}) {
        set_thread_count(threads);
        EXPECT_EQ(sorted_ranges(1001, 10), alone) << threads << " threads";
    }
    set_thread_count(0);
}

TEST(ParallelRanges, OfNothingCallNothing) {
    parallel_ranges(0, 8, [](size_t, size_t) { FAIL(); });
}

TEST(ParallelRanges, TakeAGrainOfNothingAsOne) {
    EXPECT_EQ(sorted_ranges(2, 0), (Ranges{{0, 1}, {1, 2}}));
}

TEST(ThreadCount, IsWhatWasAskedFor) {
    for (unsigned threads : {1u, 2u, 5u}) {
        set_thread_count(threads);
        EXPECT_EQ(thread_count(), threads);
    }
    set_thread_count(0);
    EXPECT_GE(thread_count(), 1u);
}

TEST(ThreadCount, IsNeverExceeded) {
    for (int limit : {1, 2}) {
        set_thread_count(unsigned(limit));
        std::atomic<int> running{0}, most{0};
        parallel_ranges(2000, 1, [&](size_t, size_t) {
            int now = ++running;
            int seen = most.load();
            while (now > seen && !most.compare_exchange_weak(seen, now)) {
            }
            running--;
        });
        EXPECT_LE(most.load(), limit);
    }
    set_thread_count(0);
}

}  // namespace
}  // namespace overlook
