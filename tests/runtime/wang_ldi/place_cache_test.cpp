// Remembered numbers are the function's, whatever was asked before and by how many threads.
#include "runtime/wang_ldi/place_cache.h"

#include <gtest/gtest.h>

#include <atomic>

#include "formats/parallel.h"
#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

uint8_t number_of(int64_t x, int64_t y) {
    return uint8_t(hash_of(1, 2, x, y) >> 56);
}

TEST(PlaceCache, AsksOnceForATileAndForgetsItForOneFarAway) {
    PlaceCache cache;
    int asked = 0;
    auto at = [&](int64_t x, int64_t y) {
        return cache.at(x, y, [&] {
            ++asked;
            return number_of(x, y);
        });
    };
    for (auto [x, y] : {std::pair<int64_t, int64_t>{0, 0}, {-1, -1}, {-5, 7}, {PlaceCache::kSide - 1, 3}})
        for (int times = 0; times < 3; ++times) EXPECT_EQ(at(x, y), number_of(x, y));
    EXPECT_EQ(asked, 4);
    EXPECT_EQ(at(PlaceCache::kSide, -PlaceCache::kSide), number_of(PlaceCache::kSide, -PlaceCache::kSide));
    EXPECT_EQ(at(0, 0), number_of(0, 0));
    EXPECT_EQ(asked, 6);
    for (int64_t far : {PlaceCache::kFarthest, -PlaceCache::kFarthest, INT64_MAX, INT64_MIN})
        for (int times = 0; times < 2; ++times) EXPECT_EQ(at(far, 1), number_of(far, 1));
    EXPECT_EQ(asked, 14);
}

TEST(PlaceCache, FindsTheSameByAllThreads) {
    PlaceCache cache;
    std::atomic<int> wrong = 0;
    parallel_ranges(64, 1, [&](size_t begin, size_t) {
        for (int64_t n = 0; n < 4000; ++n) {
            int64_t x = n * 37 % 3000 - 1500, y = (n * 11 + int64_t(begin)) % 2500 - 1200;
            wrong += cache.at(x, y, [&] { return number_of(x, y); }) != number_of(x, y);
        }
    });
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace overlook::wang_ldi
