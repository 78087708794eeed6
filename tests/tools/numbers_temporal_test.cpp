#include <gtest/gtest.h>

#include <cmath>

#include "formats/parallel.h"
#include "tests/tools/numbers_pictures.h"
#include "tools/measure/numbers/temporal.h"

namespace overlook::measure {
namespace {

view::Camera camera_of(uint32_t width, uint32_t height) {
    view::Camera camera;
    camera.position_m = {500, -300, 60};
    camera.heading_deg = 20;
    camera.pitch_deg = -25;
    camera.width_px = width;
    camera.height_px = height;
    return camera;
}

Picture plain_like(const Frame& frame) {
    return plain_picture(frame.width, frame.height, 128, 128, 128);
}

// |r| of a frame pair itself: against plain grey, whose own r is 0.
double change_along(const Motion& motion, const Frame& before, const Frame& now) {
    return temporal_error(motion, rgb_of(before), rgb_of(now), plain_like(before), plain_like(now)).mean;
}

// A sequence of pictures as W sees it, against references under a camera that stands still.
std::vector<TemporalError> errors_of(const std::vector<Picture>& test, const std::vector<Picture>& reference) {
    Frame still = mask_frame(test[0].width, test[0].height, [](uint32_t, uint32_t) { return true; });
    Motion motion = motion_between(still, still);
    std::vector<TemporalError> errors;
    for (size_t i = 1; i < test.size(); ++i) {
        errors.push_back(temporal_error(motion, test[i - 1], test[i], reference[i - 1], reference[i]));
        errors.back().frame = uint32_t(i);
    }
    return errors;
}

constexpr uint32_t kFrames = 20, kPopFrame = 8;

// Grey 100; from kPopFrame on the tile (2, 1) is lighter: at once, or by equal steps over `steps` frames. Noise: a chequered
// pattern of that many levels, the other way round in every frame.
std::vector<Picture> sequence(int pop_levels, uint32_t steps = 1, int noise_levels = 0) {
    std::vector<Picture> frames;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        uint32_t done = frame < kPopFrame ? 0 : std::min(steps, frame - kPopFrame + 1);
        int more = pop_levels * int(done) / int(steps);
        frames.push_back(grey_picture(130, 70, [=](uint32_t x, uint32_t y) {
            int noise = (x + y + frame) % 2 ? noise_levels : -noise_levels;
            return 100 + noise + (x / 32 == 2 && y / 32 == 1 ? more : 0);
        }));
    }
    return frames;
}

TEST(Motion, CarriesAStillWorldOntoItself) {
    view::Camera from = camera_of(160, 120);
    from.pitch_deg = -45;  // no horizon, before which the waves would be finer than pixels
    view::Camera yaw = from, pitch = from, dolly = from, rise = from, zoom = from;
    yaw.heading_deg += 4;
    pitch.pitch_deg += 3;
    dolly.position_m += glm::dvec3(1, 2, 0);
    rise.position_m.z += 2;
    zoom.fov_y_deg = 57;
    Frame before = plane_frame(from);
    Motion still = motion_between(before, before);
    for (const view::Camera& to : {yaw, pitch, dolly, rise, zoom}) {
        Frame now = plane_frame(to);
        Motion motion = motion_between(before, now);
        EXPECT_GT(motion.valid_count, before.ids.size() * 3 / 4);
        EXPECT_LT(change_along(motion, before, now), 0.004) << "about a grey level of rounding";
        EXPECT_GT(change_along(still, before, now), 3 * change_along(motion, before, now));
    }
}

TEST(Motion, IsTheShiftOfAPlaneSeenFromAbove) {
    view::Camera from = camera_of(90, 50);
    from.heading_deg = 0;
    from.pitch_deg = -90;
    view::Camera to = from;
    to.position_m.x += 6;
    to.position_m.y += 3;
    Motion motion = motion_between(plane_frame(from), plane_frame(to));
    double px_per_m = view::focal_px(from) / from.position_m.z;
    for (uint32_t y = 0; y < 50; ++y)
        for (uint32_t x = 0; x < 90; ++x) {
            double x_there = x + 6 * px_per_m, y_there = y - 3 * px_per_m;
            bool inside = x_there <= 89 && y_there >= 0;
            ASSERT_EQ(std::isnan(motion.x_px[y * 90 + x]), !inside);
            if (!inside) continue;
            EXPECT_NEAR(double(motion.x_px[y * 90 + x]), x_there, 1e-3);
            EXPECT_NEAR(double(motion.y_px[y * 90 + x]), y_there, 1e-3);
        }
}

TEST(Motion, LeavesOutWhatWasHidden) {
    Frame wall = mask_frame(60, 40, [](uint32_t, uint32_t) { return true; }), before = wall;
    for (uint32_t y = 0; y < 40; ++y)
        for (uint32_t x = 10; x < 20; ++x) before.depth_m[y * 60 + x] = 50;
    Motion motion = motion_between(before, wall);
    EXPECT_EQ(motion.valid_count, 60u * 40u - 10u * 40u);
    for (float& depth_m : before.depth_m) depth_m = 99.5f;
    EXPECT_EQ(motion_between(before, wall).valid_count, 60u * 40u) << "within 1 %";
}

TEST(Motion, OfASkyTurnsWithTheCameraAndDoesNotShift) {
    Frame sky = mask_frame(64, 64, [](uint32_t, uint32_t) { return false; }), moved = sky;
    moved.camera.position_m += glm::dvec3(1000, 2000, 300);
    Motion motion = motion_between(sky, moved);
    EXPECT_EQ(motion.valid_count, 64u * 64u);
    EXPECT_NEAR(double(motion.x_px[64 * 5 + 7]), 7, 1e-3);
    moved.camera.heading_deg = 180;
    EXPECT_EQ(motion_between(sky, moved).valid_count, 0u);
    EXPECT_EQ(motion_between(mask_frame(64, 64, [](uint32_t, uint32_t) { return true; }), sky).valid_count, 0u);
}

TEST(Motion, TakesPicturesOfAnyShape) {
    for (auto [width, height] : {std::pair(1u, 1u), {200u, 5u}, {3u, 120u}}) {
        view::Camera camera = camera_of(width, height);
        Frame frame = plane_frame(camera);
        Motion motion = motion_between(frame, frame);
        EXPECT_EQ(motion.valid_count, frame.ids.size());
        TemporalError error = temporal_error(motion, rgb_of(frame), plain_like(frame), rgb_of(frame), rgb_of(frame));
        EXPECT_EQ(error.tiles.size(), size_t((width + 31) / 32) * ((height + 31) / 32));
        EXPECT_GT(error.mean, 0);
    }
}

TEST(Temporal, IsNothingForAPanDrawnExactly) {
    for (auto [width, height] : {std::pair(160u, 120u), {320u, 40u}, {40u, 200u}}) {
        std::vector<TemporalError> errors;
        Frame before = plane_frame(camera_of(width, height));
        for (uint32_t frame = 1; frame < 5; ++frame) {
            view::Camera camera = camera_of(width, height);
            camera.heading_deg += frame;
            Frame now = plane_frame(camera);
            Motion motion = motion_between(before, now);
            EXPECT_GT(motion.valid_count, 0u);
            errors.push_back(temporal_error(motion, rgb_of(before), rgb_of(now), rgb_of(before), rgb_of(now)));
            EXPECT_EQ(errors.back().mean, 0);
            before = now;
        }
        EXPECT_EQ(pop_index(errors, errors).index, 1);
    }
}

TEST(Temporal, IsTheChangeOfLumaAndOfATileAlone) {
    std::vector<TemporalError> errors = errors_of(sequence(51), sequence(0));
    const TemporalError& pop = errors[kPopFrame - 1];
    EXPECT_EQ(pop.columns, 5u);
    EXPECT_EQ(pop.rows, 3u);
    EXPECT_NEAR(double(pop.tiles[1 * 5 + 2]), 0.2, 1e-6);
    EXPECT_NEAR(pop.mean, 0.2 * 32 * 32 / (130.0 * 70), 1e-6);
    for (size_t tile = 0; tile < pop.tiles.size(); ++tile)
        if (tile != 1 * 5 + 2) {
            EXPECT_EQ(pop.tiles[tile], 0);
        }
    for (size_t i = 0; i < errors.size(); ++i)
        if (i != kPopFrame - 1) {
            EXPECT_EQ(errors[i].mean, 0);
        }
}

TEST(Temporal, DoesNotMistakeAConstantErrorForUnrest) {
    std::vector<Picture> test(3, noise_picture(64, 64, 1)), reference(3, noise_picture(64, 64, 2));
    for (const TemporalError& error : errors_of(test, reference)) EXPECT_EQ(error.mean, 0);
}

TEST(Temporal, DilutesATileOfWhichFewPixelsAreSeenAgain) {
    Frame before = mask_frame(32, 32, [](uint32_t x, uint32_t y) { return x < 2 && y == 0; });
    Frame now = mask_frame(32, 32, [](uint32_t, uint32_t) { return true; });
    Motion motion = motion_between(before, now);
    ASSERT_EQ(motion.valid_count, 2u);
    Picture black = plain_picture(32, 32, 0, 0, 0), white = plain_picture(32, 32, 255, 255, 255);
    TemporalError error = temporal_error(motion, black, white, black, black);
    EXPECT_NEAR(error.mean, 1, 1e-6);
    EXPECT_NEAR(double(error.tiles[0]), 2 / 128.0, 1e-6);
}

TEST(Temporal, GivesTheSameBitsWithAnyThreadCount) {
    Frame before = plane_frame(camera_of(170, 90));
    view::Camera camera = camera_of(170, 90);
    camera.heading_deg += 2.3;
    Frame now = plane_frame(camera);
    auto measured = [&] {
        return temporal_error(motion_between(before, now), noise_picture(170, 90, 1), noise_picture(170, 90, 2), rgb_of(before),
                              rgb_of(now));
    };
    set_thread_count(1);
    TemporalError one = measured();
    set_thread_count(7);
    TemporalError many = measured();
    set_thread_count(0);
    EXPECT_EQ(many.mean, one.mean);
    EXPECT_EQ(many.tiles, one.tiles);
}

TEST(PopIndex, OfAPerfectSequenceIsOne) {
    std::vector<Picture> reference = sequence(0, 1, 5);
    std::vector<TemporalError> errors = errors_of(reference, reference);
    PopIndex pop = pop_index(errors, errors);
    EXPECT_EQ(pop.index, 1);
    EXPECT_EQ(pop.excess, 0);
    EXPECT_EQ(pop.method_median, 0);
    EXPECT_EQ(pop_index({}, {}).index, 1);
}

TEST(PopIndex, OfAKnownPopIsKnownAndAStillCameraCannotHideIt) {
    std::vector<TemporalError> floor = errors_of(sequence(0), sequence(0));
    PopIndex pop = pop_index(errors_of(sequence(51), sequence(0)), floor);
    EXPECT_NEAR(pop.index, 1 + 0.2 / 1e-3, 1e-3);
    EXPECT_EQ(pop.frame, kPopFrame);
    EXPECT_EQ(pop.tile_column, 2u);
    EXPECT_EQ(pop.tile_row, 1u);
    EXPECT_EQ(pop.floor_median, 0);
    EXPECT_EQ(pop.method_median, 0) << "the median never sees it";
}

TEST(PopIndex, IsMeasuredInTheFloorsOwnUnrest) {
    // The floor's chequers change by 10 levels each frame. A pop of 51 on top of them: |51 +- 10| is 51 in the mean.
    std::vector<TemporalError> floor = errors_of(sequence(0, 1, 5), sequence(0));
    PopIndex pop = pop_index(errors_of(sequence(51, 1, 5), sequence(0)), floor);
    double w_floor = 10 / 255.0;
    EXPECT_NEAR(pop.floor_median, w_floor, 1e-6);
    EXPECT_NEAR(pop.index, 1 + (0.2 - w_floor) / (w_floor + 1e-3), 1e-4);
    EXPECT_EQ(pop.frame, kPopFrame);
}

TEST(PopIndex, IsNotLoweredBySteadyNoiseOfTheMethod) {
    std::vector<TemporalError> floor = errors_of(sequence(0), sequence(0));
    double without = pop_index(errors_of(sequence(51), sequence(0)), floor).index;
    for (int noise : {1, 5, 12, 40}) {
        PopIndex noisy = pop_index(errors_of(sequence(51, 1, noise), sequence(0)), floor);
        EXPECT_GE(noisy.index, without * (1 - 1e-6)) << noise;
        EXPECT_GT(noisy.method_median, 0) << "which stands beside the index";
    }
}

TEST(PopIndex, TellsAFadeFromAPopOfTheSameSize) {
    std::vector<TemporalError> floor = errors_of(sequence(0), sequence(0));
    double pop = pop_index(errors_of(sequence(50, 1), sequence(0)), floor).index - 1;
    double fade = pop_index(errors_of(sequence(50, 10), sequence(0)), floor).index - 1;
    EXPECT_NEAR(pop / fade, 10, 1e-3);
}

TEST(PopIndex, FailsItsGateOnAPopAndPassesWithinTheFloorsUnrest) {
    std::vector<TemporalError> floor = errors_of(sequence(0, 1, 5), sequence(0));
    EXPECT_LE(pop_index(floor, floor).index, 1.2);
    EXPECT_LE(pop_index(errors_of(sequence(51, 10, 5), sequence(0)), floor).index, 1.2) << "a fade under the noise";
    EXPECT_GT(pop_index(errors_of(sequence(30, 1, 5), sequence(0)), floor).index, 1.2);
}

}  // namespace
}  // namespace overlook::measure
