#include "formats/crew.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <set>
#include <thread>
#include <vector>

#include "formats/parallel.h"

namespace overlook {
namespace {

class Crew : public testing::Test {
  protected:
    ~Crew() override { set_thread_count(0); }
};

// Waits until so many have come; false after a long time.
bool comes_to(const std::atomic<unsigned>& count, unsigned wanted) {
    for (int ms = 0; ms < 20000 && count.load() < wanted; ++ms) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return count.load() >= wanted;
}

TEST_F(Crew, WorksAtTheSameTimeEachUnderItsOwnNumber) {
    set_thread_count(3);
    for (int piece = 0; piece < 20; ++piece) {
        std::atomic<unsigned> here{0};
        std::vector<std::atomic<int>> calls(3);
        std::atomic<bool> all_came{true};
        work_together(3, [&](unsigned worker) {
            ++calls.at(worker);
            ++here;
            if (!comes_to(here, 3)) all_came = false;
        });
        ASSERT_TRUE(all_came);
        for (const std::atomic<int>& count : calls) ASSERT_EQ(count.load(), 1);
    }
}

TEST_F(Crew, NeverExceedsWhatWasAsked) {
    set_thread_count(2);
    for (unsigned most : {0u, 1u, 2u, 5u}) {
        unsigned allowed = std::clamp(most, 1u, 2u);
        for (int piece = 0; piece < 200; ++piece) {
            std::atomic<unsigned> calls{0};
            std::atomic<bool> numbered{true};
            work_together(most, [&](unsigned worker) {
                ++calls;
                if (worker >= allowed) numbered = false;
            });
            ASSERT_TRUE(numbered);
            ASSERT_GE(calls.load(), 1u);
            ASSERT_LE(calls.load(), allowed);
        }
    }
}

// Whoever comes late must not find the work of one that has returned: all write what is gone afterwards.
TEST_F(Crew, HasReturnedWholeWhenItReturns) {
    set_thread_count(4);
    for (int piece = 0; piece < 3000; ++piece) {
        std::vector<std::atomic<int>> work(16);
        std::atomic<size_t> next{0};
        work_together(4, [&](unsigned) {
            for (size_t i = next++; i < work.size(); i = next++) ++work[i];
        });
        for (const std::atomic<int>& done : work) ASSERT_EQ(done.load(), 1);
    }
}

TEST_F(Crew, ComesAgainAfterALongSleep) {
    set_thread_count(2);
    for (int piece = 0; piece < 5; ++piece) {
        std::atomic<unsigned> here{0};
        std::atomic<bool> came{true};
        work_together(2, [&](unsigned) {
            ++here;
            if (!comes_to(here, 2)) came = false;
        });
        ASSERT_TRUE(came);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

TEST_F(Crew, LeavesASecondCallerToItself) {
    set_thread_count(2);
    std::atomic<bool> is_taken{false}, may_end{false};
    std::thread first([&] {
        work_together(2, [&](unsigned) {
            is_taken = true;
            while (!may_end) std::this_thread::yield();
        });
    });
    while (!is_taken) std::this_thread::yield();
    std::set<unsigned> workers;
    work_together(2, [&](unsigned worker) { workers.insert(worker); });
    EXPECT_EQ(workers, std::set<unsigned>{0});
    may_end = true;
    first.join();
}

}  // namespace
}  // namespace overlook
