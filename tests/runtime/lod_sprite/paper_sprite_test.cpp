#include "runtime/lod_sprite/paper_sprite.h"

#include <gtest/gtest.h>

#include "tests/allocations.h"
#include "tests/runtime/lod_sprite/paper_fixture.h"
#include "tests/tools/synthetic_dem.h"
#include "tools/bake/terrain.h"

namespace overlook::lod_sprite::paper {
namespace {

// Hills of 129 x 129 samples, 30 x 40 m apart, flown over from the south.
struct Hills {
    terrain::Terrain terrain = *terrain::bake(overlook::test::make_hills(129, 129, 3), {}, [](double) {});
    terrain::Refiner refiner{terrain};

    view::Camera camera(double forward_m, double heading_deg = 0) const {
        view::Camera made = test::square_camera({1900, -5000 + forward_m, 2500}, heading_deg, -30);
        made.width_px = 160, made.height_px = 90, made.fov_y_deg = 60;
        return made;
    }
    terrain::Cut low(const view::Camera& at) const {
        terrain::Cut cut;
        refiner.cut_by_pixels(at, 4, cut);
        return cut;
    }
    // Takes a keyframe with a depth buffer in which everything is visible.
    static Options all_visible() {
        Options options;
        options.depth = {DepthSpace::eye, 1e9, 0};
        return options;
    }
    std::vector<float> depth(const view::Camera& at) const {
        return std::vector<float>(size_t(at.width_px) * at.height_px, float(at.near_m / 3000));
    }
    void keep(Sprite& sprite, const view::Camera& at) const { sprite.keep(at, depth(at), low(at)); }
};

TEST(PaperSprite, BeginsWithAKeyframe) {
    Hills hills;
    Sprite sprite(hills.terrain, {});
    view::Camera at = hills.camera(0);
    EXPECT_EQ(sprite.decide(at, hills.low(at)).reason, KeyReason::first);
    hills.keep(sprite, at);
    Decision again = sprite.decide(at, hills.low(at));
    EXPECT_FALSE(again.is_key());
    EXPECT_NEAR(again.error.max_px, 0, 1e-9);
    EXPECT_GT(again.error.with_centre_count, 20u);
    at.width_px = 320;
    EXPECT_EQ(sprite.decide(at, hills.low(at)).reason, KeyReason::first);
}

TEST(PaperSprite, TakesAKeyframeWhereTheMeanSquareReachesTheThreshold) {
    Hills hills;
    for (double threshold_px : {0.05, 0.2}) {
        Options options;
        options.key_error_px = threshold_px;
        Sprite sprite(hills.terrain, options);
        hills.keep(sprite, hills.camera(0));
        double error_px = 0;
        int frame = 1;
        for (;; ++frame) {
            ASSERT_LT(frame, 1000);
            view::Camera at = hills.camera(2.0 * frame);
            Decision decision = sprite.decide(at, hills.low(at));
            ASSERT_NE(decision.reason, KeyReason::jump);
            ASSERT_EQ(decision.reason == KeyReason::error, decision.error.rms_px >= threshold_px);
            if (decision.is_key()) {
                hills.keep(sprite, at);
                break;
            }
            error_px = decision.error.rms_px;
        }
        EXPECT_GT(frame, 3);
        EXPECT_GT(error_px, 0.3 * threshold_px);
        view::Camera at = hills.camera(2.0 * frame);
        EXPECT_NEAR(sprite.decide(at, hills.low(at)).error.max_px, 0, 1e-9);
    }
}

TEST(PaperSprite, TakesOneAtOnceWhereTheViewJumps) {
    Hills hills;
    Options options;
    options.key_error_px = 1e9;
    Sprite sprite(hills.terrain, options);
    hills.keep(sprite, hills.camera(0));
    double diagonal_m = std::hypot(128 * 30.0, 128 * 40.0);
    for (double share : {0.24, 0.26}) {
        view::Camera at = hills.camera(share * diagonal_m);
        EXPECT_EQ(sprite.decide(at, hills.low(at)).reason, share > 0.25 ? KeyReason::jump : KeyReason::none);
    }
    // The frame is 91 degrees wide.
    EXPECT_EQ(sprite.decide(hills.camera(0, 25), hills.low(hills.camera(0, 25))).reason, KeyReason::none);
    EXPECT_EQ(sprite.decide(hills.camera(0, 80), hills.low(hills.camera(0, 80))).reason, KeyReason::jump);
}

TEST(PaperSharedView, IsTheShareOfDirections) {
    view::Camera key = test::square_camera({0, 0, 0}, 30, 0), now = key;
    EXPECT_EQ(shared_view(key, now), 1);
    now.heading_deg += 180;
    EXPECT_EQ(shared_view(key, now), 0);
    now.heading_deg = 30 + 91;
    EXPECT_EQ(shared_view(key, now), 0);
    // Half as wide and half as high in tangents: a quarter of the directions.
    now = key;
    std::swap(now, key);
    key.fov_y_deg = 2 * std::atan(0.5) * 180 / 3.14159265358979;
    EXPECT_EQ(shared_view(key, now), 0.25);
    EXPECT_EQ(shared_view(now, key), 1);
    // Turned by half the frame's width, the middle column of the view is the key's edge.
    key = now;
    now.heading_deg += 45;
    EXPECT_NEAR(shared_view(key, now), 0.4, 0.1);
}

TEST(PaperSprite, CountsWhatStripsLose) {
    Hills hills;
    view::Camera at = hills.camera(0);
    terrain::Cut low = hills.low(at);
    std::vector<float> depth = hills.depth(at);
    Options options = Hills::all_visible();
    Sprite whole(hills.terrain, options);
    options.strips = StripOptions{};
    Sprite strips(hills.terrain, options);
    whole.keep(at, depth, low), strips.keep(at, depth, low);
    std::vector<uint8_t> alone(whole.flags(low).begin(), whole.flags(low).end());
    std::span<const uint8_t> in_strips = strips.flags(low);
    EXPECT_EQ(whole.counts().lost_to_strips_count, 0u);
    EXPECT_EQ(whole.counts().vertex_count, low.indices.size());
    EXPECT_LT(strips.counts().vertex_count, low.indices.size());
    // Triangles that reach out of the frame are hidden, and take others with them.
    EXPECT_GT(strips.counts().lost_to_strips_count, 0u);
    EXPECT_EQ(strips.counts().sprite_count + strips.counts().lost_to_strips_count, whole.counts().sprite_count);
    for (size_t i = 0; i < alone.size(); ++i) EXPECT_LE(in_strips[i], alone[i]);
}

TEST(PaperSprite, TakesNoMemoryInTheSteadyState) {
    Hills hills;
    Options options = Hills::all_visible();
    options.strips = StripOptions{};
    options.key_error_px = 1e9;
    Sprite sprite(hills.terrain, options);
    hills.keep(sprite, hills.camera(0));
    std::vector<terrain::Cut> cuts;
    for (int frame = 0; frame < 10; ++frame) cuts.push_back(hills.low(hills.camera(3.0 * frame)));
    std::vector<float> depth = hills.depth(hills.camera(0));
    uint64_t before = 0;
    for (int round = 0; round < 2; ++round) {
        before = overlook::test::allocation_count();
        for (int frame = 0; frame < 10; ++frame) {
            sprite.decide(hills.camera(3.0 * frame), cuts[size_t(frame)]);
            if (frame % 5 == 0) sprite.keep(hills.camera(3.0 * frame), depth, cuts[size_t(frame)]);
            EXPECT_GT(sprite.flags(cuts[size_t(frame)]).size(), 100u);
        }
    }
    EXPECT_EQ(overlook::test::allocation_count() - before, 0u);
}

}  // namespace
}  // namespace overlook::lod_sprite::paper
