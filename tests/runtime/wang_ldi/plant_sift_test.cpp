// What is left out of a plant's triangles shows nothing, whichever instructions the processor has.
#include "runtime/wang_ldi/plant_sift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "runtime/wang_ldi/canvas.h"
#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

constexpr int32_t kWide_px = 96, kHigh_px = 64, kLeft_px = 16, kRight_px = 80;

struct Bunch {
    std::vector<int32_t> x, y, behind;
    std::vector<float> nearness;
    std::vector<uint16_t> indices;

    PlacedVertices placed() { return {x.data(), y.data(), nearness.data(), behind.data()}; }
    uint32_t count() const { return uint32_t(indices.size() / 3); }
};

// Triangles as wide as `spread_px` about, many of them smaller than a pixel, some without area.
Bunch scattered(uint64_t seed, double spread_px, uint32_t count) {
    Random random(seed);
    Bunch bunch;
    for (uint32_t t = 0; t < count; ++t) {
        double middle_x = -8 + (kWide_px + 16) * random.next_unit(), middle_y = -8 + (kHigh_px + 16) * random.next_unit();
        for (int k = 0; k < 3; ++k) {
            bool is_same = k == 2 && t % 17 == 0;
            auto at = [&](double middle) {
                double off = (random.next_unit() - 0.5) * spread_px;
                return int32_t(std::floor((middle + off) * kCornerSteps));
            };
            int32_t x = at(middle_x), y = at(middle_y);
            if (t % 5 == 0) x = x / kCornerSteps * kCornerSteps + kCornerSteps / 2;  // on pixels' middles
            bunch.x.push_back(is_same ? bunch.x.back() : x), bunch.y.push_back(is_same ? bunch.y.back() : y);
            int32_t behind = (x < 0 ? kLeft : 0) | (x > kWide_px * kCornerSteps ? kRight : 0) | (y < 0 ? kAbove : 0) |
                             (y > kHigh_px * kCornerSteps ? kBelow : 0);
            bunch.behind.push_back(t % 23 == 0 && k == 1 ? kNear : behind);
            bunch.nearness.push_back(float(0.1 + random.next_unit()));
            bunch.indices.push_back(uint16_t(bunch.indices.size()));
        }
    }
    return bunch;
}

// How many pixels of the columns have their middles in it: on an edge, if it is the triangle's left or upper one.
int pixels_of(const Bunch& bunch, uint32_t triangle) {
    int64_t x[3], y[3];
    for (size_t k = 0; k < 3; ++k)
        x[k] = bunch.x[bunch.indices[3 * triangle + k]], y[k] = bunch.y[bunch.indices[3 * triangle + k]];
    int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0) return 0;
    if (area < 0) std::swap(x[1], x[2]), std::swap(y[1], y[2]);
    int pixels = 0;
    for (int64_t row = 0; row < kHigh_px; ++row)
        for (int64_t column = kLeft_px; column < kRight_px; ++column) {
            int64_t px = column * kCornerSteps + kCornerSteps / 2, py = row * kCornerSteps + kCornerSteps / 2;
            bool is_inside = true;
            for (size_t k = 0; k < 3; ++k) {
                size_t to = (k + 1) % 3;
                int64_t along = x[to] - x[k], across = y[to] - y[k], edge = along * (py - y[k]) - across * (px - x[k]);
                is_inside &= edge > 0 || (edge == 0 && (across < 0 || (across == 0 && along > 0)));
            }
            pixels += is_inside;
        }
    return pixels;
}

std::vector<uint16_t> kept_of(const PlantLoops& loops, Bunch& bunch, Canvas& canvas) {
    std::vector<uint16_t> kept(bunch.count());
    SiftFrame frame{kLeft_px, kRight_px, kHigh_px, canvas.stride(), canvas.row(0)};
    kept.resize(loops.sift(frame, bunch.placed(), bunch.indices.data(), bunch.count(), kept.data()));
    return kept;
}

TEST(PlantSift, WhatIsLeftOutShowsNothing) {
    uint64_t kept_count = 0, all = 0;
    for (double spread_px : {0.5, 1.5, 4.0, 30.0, 200.0})
        for (uint32_t count : {1u, 7u, 8u, 127u}) {
            Bunch bunch = scattered(uint64_t(spread_px * 10) + count, spread_px, count);
            Canvas canvas;
            canvas.fit(kWide_px, kHigh_px);
            std::vector<uint16_t> kept = kept_of(kPlantLoopsAnywhere, bunch, canvas);
            EXPECT_TRUE(kept == kept_of(best_plant_loops(), bunch, canvas)) << spread_px;
            std::vector<uint8_t> is_kept(count), is_cut(count);
            for (uint16_t one : kept) is_kept[one & ~kIsCut] = 1, is_cut[one & ~kIsCut] = (one & kIsCut) != 0;
            for (uint32_t t = 0; t < count; ++t) {
                int32_t all_behind = ~0, any = 0;
                for (size_t k = 0; k < 3; ++k) all_behind &= bunch.behind[3 * t + k], any |= bunch.behind[3 * t + k];
                if (any & kNear) {
                    EXPECT_EQ(is_cut[t], (all_behind & ~kFar) == 0);
                } else if (int pixels = pixels_of(bunch, t); pixels > 0) {
                    EXPECT_TRUE(is_kept[t] && !is_cut[t]) << spread_px << " " << t;
                } else if (spread_px < 1) {
                    EXPECT_FALSE(is_kept[t]);  // of at most one pixel each
                }
            }
            kept_count += kept.size(), all += count;
        }
    EXPECT_GT(kept_count, all / 4);
    EXPECT_LT(kept_count, all * 3 / 4);
}

TEST(PlantSift, OnePixelThatIsNearerAlreadyIsNotDrawnAgain) {
    Bunch bunch = scattered(3, 1.2, 127);
    Canvas canvas;
    canvas.fit(kWide_px, kHigh_px);
    size_t open = kept_of(best_plant_loops(), bunch, canvas).size();
    for (uint32_t y = 0; y < kHigh_px; ++y)
        for (int32_t x = 0; x < kWide_px; ++x) canvas.row(y)[x] = pixel_key(1.5f, 0);
    std::vector<uint16_t> kept = kept_of(best_plant_loops(), bunch, canvas);
    EXPECT_TRUE(kept == kept_of(kPlantLoopsAnywhere, bunch, canvas));
    EXPECT_GT(kept.size(), 0u);
    EXPECT_LT(kept.size(), open);
    for (uint16_t one : kept) {
        if (one & kIsCut || pixels_of(bunch, one) != 1) continue;
        auto nearness = {bunch.nearness[3u * one], bunch.nearness[3u * one + 1], bunch.nearness[3u * one + 2]};
        EXPECT_GE(std::max(nearness), 1 / 1.5f - 1e-5f);  // some of it is not farther
    }
}

TEST(PlantSift, VerticesComeToTheSamePlacesByAllInstructions) {
    VertexFrame frame{{300, 20, 5, 10}, {-10, 5, 290, -40}, {0.1f, 0.9f, 0.05f, 1}, {48, 32}, {96, 64}, 0.1f};
    Random random(5);
    for (uint32_t count : {1u, 8u, 13u, 200u}) {
        std::vector<float> at[3];
        for (auto& axis : at)
            for (uint32_t v = 0; v < count; ++v) axis.push_back(float(4 * random.next_unit() - 2));
        at[1][0] = -1e9f;
        std::vector<Bunch> placed(2);
        for (size_t n = 0; n < 2; ++n) {
            Bunch& to = placed[n];
            to.x.resize(count), to.y.resize(count), to.behind.resize(count), to.nearness.resize(count);
            (n == 0 ? kPlantLoopsAnywhere : best_plant_loops())
                .place(frame, at[0].data(), at[1].data(), at[2].data(), count, to.placed());
        }
        EXPECT_TRUE(placed[0].x == placed[1].x && placed[0].y == placed[1].y && placed[0].behind == placed[1].behind);
        EXPECT_TRUE(placed[0].nearness == placed[1].nearness);
        EXPECT_EQ(placed[0].behind[0], kNear);
        for (uint32_t v = 0; v < count; ++v) {
            double seen[3];
            for (auto [k, axis] : {std::pair(0, frame.right), {1, frame.up}, {2, frame.forward}})
                seen[k] = double(axis[0]) * at[0][v] + double(axis[1]) * at[1][v] + double(axis[2]) * at[2][v] + double(axis[3]);
            if (placed[0].behind[v] & (kNear | kFar)) continue;
            EXPECT_NEAR(placed[0].x[v], (48 + seen[0] / seen[2]) * kCornerSteps,
                        2 + 1e-5 * std::abs(seen[0] / seen[2]) * kCornerSteps);
            EXPECT_NEAR(placed[0].y[v], (32 - seen[1] / seen[2]) * kCornerSteps,
                        2 + 1e-5 * std::abs(seen[1] / seen[2]) * kCornerSteps);
        }
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
