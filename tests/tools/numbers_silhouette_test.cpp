#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <tuple>

#include "tests/tools/numbers_pictures.h"
#include "tools/measure/numbers/distance_transform.h"
#include "tools/measure/numbers/silhouette.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kHorizon = 20;

Frame horizon_frame(uint32_t width = 60, uint32_t height = 50, uint32_t horizon = kHorizon) {
    return mask_frame(width, height, [horizon](uint32_t, uint32_t y) { return y >= horizon; });
}
size_t at(const Frame& frame, uint32_t x, uint32_t y) {
    return size_t(y) * frame.width + x;
}
void show_background(Frame& frame, uint32_t x, uint32_t y) {
    frame.ids[at(frame, x, y)] = kBackground;
    frame.depth_m[at(frame, x, y)] = std::numeric_limits<float>::infinity();
}

// A near ridge at 100 m before a valley at 200 m, one thing, the crest in a column.
Frame ridge_frame(uint32_t crest) {
    Frame frame = mask_frame(60, 40, [](uint32_t, uint32_t) { return true; });
    for (uint32_t y = 0; y < 40; ++y)
        for (uint32_t x = crest; x < 60; ++x) frame.depth_m[at(frame, x, y)] = 200;
    return frame;
}

TEST(DistanceTransform, EqualsSearchingAllPixels) {
    for (auto [width, height] : {std::pair(1u, 1u), {1u, 40u}, {40u, 1u}, {31u, 23u}, {90u, 70u}})
        for (uint32_t one_of : {1u, 7u, 200u}) {
            std::vector<uint8_t> marked(size_t(width) * height);
            uint32_t seed = width * one_of;
            for (uint8_t& mark : marked) mark = ((seed = seed * 1664525u + 1013904223u) >> 16) % one_of == 0;
            marked.back() = 1;
            std::vector<uint32_t> distances = squared_distances_px(width, height, marked);
            for (uint32_t i = 0; i < marked.size(); ++i) {
                uint32_t nearest = kNoneMarked;
                for (uint32_t j = 0; j < marked.size(); ++j) {
                    int dx = int(i % width) - int(j % width), dy = int(i / width) - int(j / width);
                    if (marked[j]) nearest = std::min(nearest, uint32_t(dx * dx + dy * dy));
                }
                ASSERT_EQ(distances[i], nearest) << width << "x" << height << ", pixel " << i;
            }
        }
}

TEST(DistanceTransform, SaysThatNothingIsMarked) {
    for (uint32_t distance : squared_distances_px(9, 4, std::vector<uint8_t>(36))) EXPECT_EQ(distance, kNoneMarked);
}

TEST(Silhouette, ShiftedByNPixelsIsOffByN) {
    for (uint32_t n = 0; n <= 12; ++n) {
        auto left_of = [](uint32_t edge) { return mask_frame(80, 33, [edge](uint32_t x, uint32_t) { return x < edge; }); };
        SilhouetteError upright = silhouette_error(left_of(30 + n), left_of(30));
        EXPECT_DOUBLE_EQ(upright.p95_px, n);
        EXPECT_DOUBLE_EQ(upright.max_px, n);
        EXPECT_EQ(upright.test_border_px, 33u);
        SilhouetteError level = silhouette_error(horizon_frame(60, 50, kHorizon), horizon_frame(60, 50, kHorizon + n));
        EXPECT_DOUBLE_EQ(level.p95_px, n);
        EXPECT_DOUBLE_EQ(level.max_px, n);
    }
}

TEST(Silhouette, GrownDiscIsOffByWhatItGrew) {
    auto disc = [](double radius_px) {
        return mask_frame(101, 91, [=](uint32_t x, uint32_t y) { return std::hypot(x - 50.0, y - 45.0) <= radius_px; });
    };
    SilhouetteError error = silhouette_error(disc(33), disc(28));
    EXPECT_NEAR(error.p95_px, 5, 0.8);
    EXPECT_NEAR(error.max_px, 5, 1.0);
}

TEST(Silhouette, LostSpireShowsInTheMaximumOnly) {
    Frame bare = horizon_frame(600, 50);
    Frame spire = mask_frame(600, 50, [](uint32_t x, uint32_t y) { return y >= kHorizon || (x == 300 && y >= kHorizon - 12); });
    for (const SilhouetteError& error : {silhouette_error(bare, spire), silhouette_error(spire, bare)}) {
        EXPECT_DOUBLE_EQ(error.max_px, 12);
        EXPECT_DOUBLE_EQ(error.p95_px, 0);
    }
}

TEST(Silhouette, LooksBothWays) {
    auto island = [](uint32_t x, uint32_t y) { return x >= 20 && x < 60 && y >= 2 && y < 8; };
    Frame bare = horizon_frame(80, 70, 40);
    Frame with = mask_frame(80, 70, [=](uint32_t x, uint32_t y) { return y >= 40 || island(x, y); });
    for (const SilhouetteError& error : {silhouette_error(bare, with), silhouette_error(with, bare)}) {
        EXPECT_DOUBLE_EQ(error.max_px, 38);
        EXPECT_GT(error.p95_px, 30);
    }
}

TEST(Silhouette, WithoutAnyBorderIsNotOff) {
    Frame nothing = mask_frame(20, 10, [](uint32_t, uint32_t) { return false; });
    Frame everything = mask_frame(20, 10, [](uint32_t, uint32_t) { return true; });
    for (const Frame* test : {&nothing, &everything})
        for (const Frame* reference : {&nothing, &everything}) EXPECT_EQ(silhouette_error(*test, *reference).max_px, 0);
    Frame pixel = mask_frame(1, 1, [](uint32_t, uint32_t) { return true; });
    EXPECT_EQ(silhouette_error(pixel, pixel).max_px, 0);
}

TEST(Silhouette, OfOneAloneIsMeasuredToTheOutside) {
    Frame nothing = mask_frame(60, 50, [](uint32_t, uint32_t) { return false; });
    Frame block = mask_frame(60, 50, [](uint32_t x, uint32_t y) { return x >= 20 && x < 40 && y >= 20 && y < 30; });
    EXPECT_DOUBLE_EQ(silhouette_error(nothing, block).max_px, 21);
    EXPECT_DOUBLE_EQ(silhouette_error(block, nothing).max_px, 21);
    EXPECT_DOUBLE_EQ(silhouette_error(horizon_frame(60, 50, 0), horizon_frame(60, 50, 1)).max_px, 2)
        << "a horizon just beyond the top";
}

TEST(Silhouette, FailsItsGateWhenTheHorizonIsOffByMoreThanAsked) {
    double asked_px = 2;
    EXPECT_LE(silhouette_error(horizon_frame(60, 50, 21), horizon_frame(60, 50, 20)).p95_px, asked_px + 1);
    EXPECT_GT(silhouette_error(horizon_frame(60, 50, 24), horizon_frame(60, 50, 20)).p95_px, asked_px + 1);
}

TEST(Holes, AreNoneInTheReferenceItself) {
    Frame frame = horizon_frame();
    HolePixels holes = hole_pixels(frame, frame, 1);
    EXPECT_EQ(holes.count, 0u);
    EXPECT_EQ(holes.lost_px, 0u);
    EXPECT_EQ(holes.thing_px, 60u * 30u);
}

TEST(Holes, OfKnownPixelsAreCounted) {
    Frame reference = horizon_frame(), test = reference;
    for (auto [x, y] : {std::pair(30u, 30u), {31u, 30u}, {0u, 49u}, {59u, 25u}}) show_background(test, x, y);
    test.ids[at(test, 10, 40)] = 2;
    test.depth_m[at(test, 20, 40)] = 102;    // 2 % deeper
    test.depth_m[at(test, 21, 40)] = 100.5;  // within 1 %
    test.depth_m[at(test, 22, 40)] = 50;     // nearer
    HolePixels holes = hole_pixels(test, reference, 1);
    EXPECT_EQ(holes.background, 4u);
    EXPECT_EQ(holes.other_thing, 1u);
    EXPECT_EQ(holes.deeper, 1u);
    EXPECT_EQ(holes.count, 6u);
    EXPECT_EQ(holes.lost_px, 5u);
    EXPECT_EQ(holes.mask[at(test, 30, 30)], 1);
    EXPECT_EQ(holes.mask[at(test, 10, 40)], 2);
    EXPECT_EQ(holes.mask[at(test, 20, 40)], 3);
}

TEST(Holes, WithinOneAndAHalfPixelsOfTheBorderAreNotCounted) {
    for (uint32_t below = 0; below < 6; ++below) {
        Frame reference = horizon_frame(), test = reference;
        show_background(test, 30, kHorizon + below);
        EXPECT_EQ(hole_pixels(test, reference, 1).count, below > 1 ? 1u : 0u) << below;
        EXPECT_EQ(hole_pixels(test, reference, 1).lost_px, 1u);
    }
}

TEST(Holes, DiagonallyNextToTheBorderAreNotCounted) {
    Frame reference = horizon_frame();
    show_background(reference, 10, 35);  // its border: the four pixels around
    for (auto [x, y, count] : {std::tuple(12u, 36u, 0u), {11u, 37u, 0u}, {13u, 35u, 1u}, {12u, 37u, 1u}}) {
        Frame test = reference;
        show_background(test, x, y);
        EXPECT_EQ(hole_pixels(test, reference, 1).count, count) << x << ", " << y;
    }
}

TEST(Holes, OfDepthForgiveACrestMovedByAPixelAndNoMore) {
    Frame reference = ridge_frame(30);
    for (uint32_t moved = 0; moved < 8; ++moved) {
        HolePixels holes = hole_pixels(ridge_frame(30 - moved), reference, 1);
        EXPECT_EQ(holes.deeper, moved > 2 ? (moved - 2) * 40 : 0) << moved;
        EXPECT_EQ(holes.count, holes.deeper);
    }
}

TEST(Holes, AreThoseOfTheThingAskedForAlone) {
    Frame reference = horizon_frame(), test = reference;
    for (uint32_t y = 30; y < 50; ++y)
        for (uint32_t x = 0; x < 60; ++x) reference.ids[at(reference, x, y)] = test.ids[at(test, x, y)] = 7;
    show_background(test, 30, 40);
    EXPECT_EQ(hole_pixels(test, reference, 1).count, 0u);
    EXPECT_EQ(hole_pixels(test, reference, 7).count, 1u);
    EXPECT_EQ(hole_pixels(test, reference, 8).thing_px, 0u);
}

TEST(Holes, FailTheirGateWithASinglePixel) {
    Frame reference = mask_frame(1, 1, [](uint32_t, uint32_t) { return true; });
    Frame empty = mask_frame(1, 1, [](uint32_t, uint32_t) { return false; });
    EXPECT_EQ(hole_pixels(reference, reference, 1).count, 0u);
    EXPECT_EQ(hole_pixels(empty, reference, 1).count, 1u);
    EXPECT_EQ(hole_pixels(reference, empty, 1).count, 0u);
}

// The frame with so many more rows and columns of what the function says stands outside it.
Frame around(const Frame& frame, uint32_t margin, const std::function<bool(uint32_t x, uint32_t y)>& is_surface) {
    Frame wide = mask_frame(frame.width + 2 * margin, frame.height + 2 * margin, is_surface);
    wide.camera = frame.camera;
    return wide;
}

TEST(Holes, AtTheOutlineAreForgivenForABorderJustOutsideAlone) {
    Frame reference = mask_frame(30, 20, [](uint32_t, uint32_t) { return true; }), test = reference;
    show_background(test, 12, 0);
    uint32_t margin = surroundings_px(0);
    HolePixels unknown = hole_pixels(test, reference, 1);
    EXPECT_EQ(unknown.count, 1u);
    EXPECT_TRUE(unknown.needs_surroundings);
    Frame whole = around(reference, margin, [](uint32_t, uint32_t) { return true; });
    EXPECT_EQ(hole_pixels(test, reference, 1, {0, &whole}).count, 1u) << "ground all round: a real hole in the outermost row";
    Frame horizon = around(reference, margin, [=](uint32_t, uint32_t y) { return y >= margin; });
    EXPECT_EQ(hole_pixels(test, reference, 1, {0, &horizon}).count, 0u) << "the sky begins one row higher";
    Frame far_horizon = around(reference, margin, [=](uint32_t, uint32_t y) { return y + 2 >= margin; });
    EXPECT_EQ(hole_pixels(test, reference, 1, {0, &far_horizon}).count, 1u) << "two rows of ground outside";
}

TEST(Holes, FarFromTheOutlineNeedNoSurroundings) {
    Frame reference = mask_frame(40, 40, [](uint32_t, uint32_t) { return true; }), test = reference;
    show_background(test, 20, 20);
    EXPECT_FALSE(hole_pixels(test, reference, 1).needs_surroundings);
    EXPECT_TRUE(hole_pixels(test, reference, 1, {30}).needs_surroundings);
}

// A near slope at 100 m below a crest in a row, farther ground at 200 m above it, all one thing; the eye looks level.
Frame crest_frame(uint32_t crest) {
    Frame frame = mask_frame(60, 60, [](uint32_t, uint32_t) { return true; });
    for (uint32_t y = 0; y < crest; ++y)
        for (uint32_t x = 0; x < 60; ++x) frame.depth_m[at(frame, x, y)] = 200;
    return frame;
}

TEST(Holes, CrestMayStandAsMuchLowerAsWasPromised) {
    Frame reference = crest_frame(20);
    for (double promised_px : {0.0, 1.0, 4.0, 8.0})
        for (uint32_t lower : {1u, 2u, 3u, 5u, 6u, 9u, 10u, 11u, 14u}) {
            HolePixels holes = hole_pixels(crest_frame(20 + lower), reference, 1, {promised_px});
            uint32_t forgiven = promised_px > 0 ? std::max(2u, uint32_t(promised_px + 1.5)) : 2;
            EXPECT_EQ(holes.deeper, lower > forgiven ? (lower - forgiven) * 60 : 0) << promised_px << " px, lower by " << lower;
            EXPECT_EQ(holes.count + holes.allowed, lower > 2 ? (lower - 2) * 60 : 0) << "the strict count";
        }
}

TEST(Holes, SkylineMayStandAsMuchLowerAsWasPromised) {
    Frame reference = horizon_frame();
    for (uint32_t lower : {1u, 2u, 3u, 9u, 10u, 11u, 12u}) {
        Frame test = horizon_frame(60, 50, kHorizon + lower);
        EXPECT_EQ(hole_pixels(test, reference, 1, {8}).count, lower > 9 ? (lower - 9) * 60 : 0) << lower;
        EXPECT_EQ(hole_pixels(test, reference, 1).count, lower > 2 ? (lower - 2) * 60 : 0) << lower;
    }
}

// Where a near thing's outline stands before a far one both may draw back a little, and the sky looks through; not elsewhere.
TEST(Holes, ThingsBeforeThingsHaveBordersToo) {
    Frame reference = ridge_frame(30);
    for (uint32_t x : {10u, 28u, 29u, 30u, 31u, 32u, 50u}) {
        Frame test = reference;
        show_background(test, x, 20);
        bool is_at_step = x >= 28 && x <= 31;
        EXPECT_EQ(hole_pixels(test, reference, 1, {0, nullptr, true}).count, is_at_step ? 0u : 1u) << x;
        EXPECT_EQ(hole_pixels(test, reference, 1).count, 1u) << x;
    }
    // A steep plane steps by more than that from pixel to pixel and has no border.
    for (uint32_t y = 0; y < 40; ++y)
        for (uint32_t x = 0; x < 60; ++x) reference.depth_m[at(reference, x, y)] = 100 / (1 + 0.1f * float(x) + 0.2f * float(y));
    Frame test = reference;
    show_background(test, 20, 20);
    EXPECT_EQ(hole_pixels(test, reference, 1, {0, nullptr, true}).count, 1u);
}

TEST(Holes, CrackIsOneWhateverWasPromised) {
    Frame reference = crest_frame(20);
    for (uint32_t y = 0; y < 8; ++y)
        for (uint32_t x = 0; x < 60; ++x) show_background(reference, x, y);
    // Below the crest by less than the promise, two rows high, four columns wide: ground before and above it.
    for (uint32_t top : {22u, 24u, 40u}) {
        Frame deep = reference, through = reference;
        for (uint32_t y = top; y < top + 2; ++y)
            for (uint32_t x = 30; x < 34; ++x) {
                deep.depth_m[at(deep, x, y)] = 150;
                show_background(through, x, y);
            }
        EXPECT_EQ(hole_pixels(through, reference, 1, {8}).background, 8u) << top;
        HolePixels holes = hole_pixels(deep, reference, 1, {8});
        EXPECT_EQ(holes.deeper, 8u) << top;
        EXPECT_EQ(holes.allowed, 0u) << top;
    }
}

TEST(Holes, UprightCrackIsOneFartherFromTheCrestThanPromised) {
    Frame reference = crest_frame(20), test = reference;
    for (uint32_t y = 35; y < 60; ++y) test.depth_m[at(test, 30, y)] = 180;
    EXPECT_EQ(hole_pixels(test, reference, 1, {8}).count, 25u);
}

TEST(Holes, OtherThingsAreNeverPromised) {
    Frame reference = crest_frame(20), test = reference;
    test.ids[at(test, 30, 24)] = 2;
    EXPECT_EQ(hole_pixels(test, reference, 1, {8}).other_thing, 1u);
}

// A plane seen straight from above, lowered by so many metres, with so many more pixels on every side.
Frame plane_below(double lower_m, uint32_t margin = 0) {
    view::Camera camera;
    camera.width_px = camera.height_px = 64 + 2 * margin;
    camera.fov_y_deg = 2 * std::atan(camera.height_px / 64.0) * 180 / std::numbers::pi;
    camera.pitch_deg = -90;
    camera.position_m = {0, 0, 1000 + lower_m};
    return plane_frame(camera);
}

TEST(Holes, GroundLoweredStraightBelowTheEyeHardlyMoves) {
    Frame reference = plane_below(0), lowered = plane_below(100), sunk = plane_below(500);
    EXPECT_EQ(hole_pixels(lowered, reference, 1).count, 64u * 64u) << "10 % deeper everywhere";
    // Places lowered by a tenth of the way stand too far in by a tenth of their way from the middle: 4.5 px in a corner.
    uint32_t margin = surroundings_px(4);
    Frame wide = plane_below(0, margin);
    HolePixels holes = hole_pixels(lowered, reference, 1, {4, &wide});
    EXPECT_EQ(holes.count, 0u);
    EXPECT_EQ(holes.allowed, 64u * 64u);
    // By half of it: 22 px in a corner, and 5.5 or less within 11 px of the middle.
    size_t near_middle = hole_pixels(sunk, reference, 1, {4, &wide}).allowed;
    EXPECT_GT(near_middle, 250u);
    EXPECT_LT(near_middle, 400u);
}

}  // namespace
}  // namespace overlook::measure
