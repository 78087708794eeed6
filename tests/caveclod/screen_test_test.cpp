// Whether a split is wanted, by one camera's screen: the ways to say so agree.
#include "runtime/caveclod/screen_test.h"

#include <gtest/gtest.h>

#include "tests/caveclod/flights.h"

namespace overlook::caveclod {
namespace {

using flights::camera_at;
using flights::flown;
using flights::hills;
using flights::mesh_of;
using flights::plain;

// Close over the hills, with some of them behind.
view::Camera low(double t) {
    return camera_at(32 + 20 * std::sin(t), 32 - 20 * std::cos(t), 8, -t * 90, -20);
}

// The short way never says that something stays which the long way would change.
TEST(ScreenTest, AnswersTheShortWayAsTheLongOne) {
    const Hierarchy& h = hills();
    Mesh mesh = mesh_of(h);
    size_t within = 0, seen_within = 0, kept = 0, all = 0;
    for (int pose = 0; pose < 60; ++pose) {
        ScreenTest test(mesh, flown(0.1 * pose), plain());
        for (double limit_px : {0.1, 1.0, 4.0}) {
            double reach = test.reach_of(limit_px);
            for (uint32_t i = 0; i < h.split_count(); ++i) {
                ++all;
                if (test.is_within(test.sphere(i), reach)) {
                    ++within;
                    ASSERT_LE(test(i).error_px, limit_px);
                }
                if (test.is_seen_within(test.sphere(i), limit_px)) {
                    ++seen_within;
                    ASSERT_LE(test(i).seen_error_px, limit_px);
                }
                if (test.is_kept(test.sphere(i))) {
                    ++kept;
                    ASSERT_FALSE(test(i).wants_collapse);
                }
            }
        }
    }
    EXPECT_GT(within, all / 200);
    EXPECT_GT(seen_within, all / 10);
    EXPECT_GT(kept, all / 50);
}

TEST(ScreenTest, AnswersTheShortWayWhereNoBandLiesBetween) {
    Mesh mesh = mesh_of(hills());
    Settings settings = plain();
    settings.collapse_share = 1, settings.error_px = 1;
    for (double guard_deg : {0.0, 10.0}) {
        settings.guard_deg = guard_deg;
        size_t sure = 0, split = 0;
        for (int pose = 0; pose < 120; ++pose) {
            for (double silhouette_px : {0.0, 0.3}) {
                settings.silhouette_error_px = silhouette_px;
                ScreenTest test(mesh, pose % 2 == 0 ? flown(0.05 * pose) : low(0.05 * pose), settings);
                for (uint32_t i = 0; i < mesh.split_count(); ++i) {
                    split += test(i).must_split;
                    if (!test.is_surely_split(test.sphere(i))) continue;
                    ++sure;
                    ASSERT_TRUE(test(i).must_split);
                }
            }
        }
        EXPECT_GT(sure, split / 4);
    }
    settings.culls_back_faces = true;
    ScreenTest culling(mesh, flown(0), settings);
    for (uint32_t i = 0; i < mesh.split_count(); ++i) ASSERT_FALSE(culling.is_surely_split(culling.sphere(i)));
}

}  // namespace
}  // namespace overlook::caveclod
