// The fast warper shows what the exact one shows, with every kind of vectors and any number of threads.
#include "runtime/wang_ldi/fast_warp.h"

#include <gtest/gtest.h>

#include "formats/parallel.h"
#include "runtime/wang_ldi/project_samples.h"
#include "tests/runtime/wang_ldi/field_images.h"

namespace overlook::wang_ldi {
namespace {

struct FastField : DrawnField {
    std::vector<PreparedLdi> prepared;
    FarImages far;

    explicit FastField(Ground ground_, bool has_splats = false, const PlacementOptions& planting = {})
        : DrawnField(std::move(ground_), planting) {
        images.has_splats = has_splats;
        for (Ldi& ldi : ldis) {
            if (has_splats)
                for (uint32_t s = 0; s < ldi.sample_count(); ++s) ldi.splats.push_back(uint8_t(8 + s * 7 % 40));
            prepared.push_back(PreparedLdi::of(ldi));
        }
        far = DrawnField::far();
    }
    PreparedAt at_hand() const {
        return [this](uint64_t index) { return &prepared[index]; };
    }
};
const FastField& hilly(bool has_splats) {
    static const FastField without(Ground(hills()), false), with(Ground(hills()), true);
    return has_splats ? with : without;
}
// At head height, from above, amid a tile's plants, and very near.
std::vector<view::Camera> cameras(const Ground& ground) {
    std::vector<view::Camera> all;
    for (int n = 0; n < 6; ++n) {
        glm::dvec2 at(401.3 + 37 * n, -533.1 + 21 * n);
        double above = n == 4 ? 25 : n == 5 ? 0.4 : 1.8;
        all.push_back(head_camera({at, ground.height_m(at) + above}, 70.0 * n, n == 4 ? -50 : -8));
    }
    return all;
}
size_t differing(const Warped& a, const Warped& b) {
    size_t count = 0;
    for (size_t p = 0; p < a.colours.size(); ++p) count += a.colours[p] != b.colours[p] || a.depth_m[p] != b.depth_m[p];
    return count;
}

TEST(FastWarp, ShowsWhatTheExactWarperShows) {
    uint64_t samples = 0, pixels = 0;
    for (bool has_splats : {false, true})
        for (bool fades : {false, true}) {
            const FastField& test = hilly(has_splats);
            Field field = test.field(fades ? test.far_options() : paper_options(test.images));
            FastWarp fast;
            for (const view::Camera& camera : cameras(test.ground))
                for (Hiding hiding : {Hiding::by_order, Hiding::by_depth}) {
                    FieldList list = list_of(field, camera);
                    Warped exact = empty_picture(camera), quick;
                    WarpCounts counts = warp_field(camera, field, list, test.all(), hiding, exact, &test.far);
                    WarpCounts of_quick = fast.warp(camera, field, list, test.at_hand(), {hiding, false}, quick, &test.far);
                    EXPECT_LE(differing(exact, quick), exact.colours.size() / 100000)
                        << "splats " << has_splats << ", fades " << fades;
                    EXPECT_EQ(of_quick.samples_drawn, counts.samples_drawn);
                    EXPECT_EQ(of_quick.pixels_written, counts.pixels_written);
                    EXPECT_LE(of_quick.samples, counts.samples);
                    samples += counts.samples_drawn, pixels += exact.colours.size();
                }
        }
    EXPECT_GT(samples, pixels);
}

// Whether the line of sight through a pixel's middle meets the ground before it is so deep.
bool is_behind_ground(const Ground& ground, const view::Camera& camera, size_t pixel, float depth_m) {
    view::Axes axes = view::axes_of(camera);
    double x = double(pixel % camera.width_px) + 0.5 - camera.width_px / 2.0,
           y = camera.height_px / 2.0 - double(pixel / camera.width_px) - 0.5;
    glm::dvec3 line = axes.forward + (x * axes.right + y * axes.up) / view::focal_px(camera);
    for (double depth = 0.25; depth < double(depth_m); depth += 0.25) {
        glm::dvec3 at = camera.position_m + depth * line;
        if (ground.height_m(glm::dvec2(at)) > at.z) return true;
    }
    return false;
}

// Where the ground is drawn too, what it hides shows nowhere, listed or not.
TEST(FastWarp, WhatTheGroundHidesIsBehindIt) {
    PlacementOptions low;  // so that what stands before a valley does not hide what is in it
    low.highest_m = 120;
    FastField test(Ground(hills()), false, low);
    FieldOptions options = test.far_options();
    Field all = test.field(options);
    options.ground_error_px = 1;
    Field seen = test.field(options);
    FastWarp fast;
    size_t hidden_px = 0, fewer = 0;
    for (view::Camera camera : cameras(test.ground))
        for (double heading : {0.0, 120.0, 240.0}) {
            camera.heading_deg += heading;
            Warped whole, picture, exact = empty_picture(camera);
            FieldList list = list_of(seen, camera);
            uint64_t samples =
                fast.warp(camera, all, list_of(all, camera), test.at_hand(), {Hiding::by_depth, false}, whole, &test.far).samples;
            fewer +=
                samples - fast.warp(camera, seen, list, test.at_hand(), {Hiding::by_depth, false}, picture, &test.far).samples;
            warp_field(camera, seen, list, test.all(), Hiding::by_depth, exact, &test.far);
            EXPECT_LE(differing(exact, picture), exact.colours.size() / 100000);
            for (size_t p = 0; p < whole.colours.size(); ++p) {
                if (whole.colours[p] == picture.colours[p] && whole.depth_m[p] == picture.depth_m[p]) continue;
                ++hidden_px;
                ASSERT_GE(picture.depth_m[p], whole.depth_m[p]);
                ASSERT_TRUE(is_behind_ground(test.ground, camera, p, whole.depth_m[p])) << p << " at " << whole.depth_m[p];
            }
        }
    EXPECT_GT(hidden_px, 2000u);
    EXPECT_GT(fewer, 20000u);
}

// Before the eye plants have splats of more than 64 pixels of a finer picture.
TEST(FastWarp, OfAFinerPictureSplatsAreAsWide) {
    const FastField& test = hilly(true);
    Field field = test.field(test.far_options());
    FastWarp fast;
    uint64_t coarse_px = 0, fine_px = 0, cut_px = 0;
    for (view::Camera camera : cameras(test.ground)) {
        camera.width_px = 160, camera.height_px = 120;
        FieldList list = list_of(field, camera);
        Warped coarse;
        coarse_px += fast.warp(camera, field, list, test.at_hand(), {Hiding::by_depth, false}, coarse, &test.far).pixels_written;
        camera.width_px *= 4, camera.height_px *= 4;
        for (uint32_t finer : {1u, 4u}) {
            Warped exact = empty_picture(camera), quick;
            WarpCounts counts = warp_field(camera, field, list, test.all(), Hiding::by_depth, exact, &test.far, finer);
            WarpCounts of_quick =
                fast.warp(camera, field, list, test.at_hand(), {Hiding::by_depth, false, true, finer}, quick, &test.far);
            EXPECT_LE(differing(exact, quick), exact.colours.size() / 100000) << finer;
            EXPECT_EQ(of_quick.pixels_written, counts.pixels_written) << finer;
            (finer == 1 ? cut_px : fine_px) += counts.pixels_written;
        }
    }
    EXPECT_GT(fine_px, cut_px);
    EXPECT_LT(fine_px, 16 * coarse_px) << "each is as wide as before or, where it filled a part of a pixel, narrower";
}

// Of widths and heights and places that are no multiples of eight too, and whatever is behind the eye or beside the picture.
TEST(FastWarp, AllKindsOfVectorsGiveTheSameNumbers) {
    const FastField& test = hilly(true);
    Field field = test.field(test.far_options());
    FastWarp fast;
    for (view::Camera camera : cameras(test.ground)) {
        camera.width_px = 333, camera.height_px = 131;
        FieldList list = list_of(field, camera);
        for (Hiding hiding : {Hiding::by_order, Hiding::by_depth}) {
            Warped wide, plain;
            WarpCounts one = fast.warp(camera, field, list, test.at_hand(), {hiding, true, true}, wide, &test.far);
            WarpCounts other = fast.warp(camera, field, list, test.at_hand(), {hiding, true, false}, plain, &test.far);
            EXPECT_TRUE(one == other);
            EXPECT_TRUE(wide.colours == plain.colours);
            EXPECT_TRUE(wide.depth_m == plain.depth_m);
        }
    }
}

TEST(FastWarp, AnyNumberOfThreadsDrawsTheSame) {
    const FastField& test = hilly(false);
    Field field = test.field(test.far_options());
    view::Camera camera = cameras(test.ground)[1];
    FieldList list = list_of(field, camera);
    for (Hiding hiding : {Hiding::by_order, Hiding::by_depth}) {
        set_thread_count(1);
        FastWarp fast;
        Warped one, many;
        WarpCounts counts = fast.warp(camera, field, list, test.at_hand(), {hiding}, one, &test.far);
        uint64_t filled = fast.holes_filled();
        for (unsigned threads : {2u, 3u, 8u, 2u}) {
            set_thread_count(threads);
            EXPECT_TRUE(fast.warp(camera, field, list, test.at_hand(), {hiding}, many, &test.far) == counts) << threads;
            EXPECT_TRUE(many.colours == one.colours && many.depth_m == one.depth_m) << threads;
            EXPECT_EQ(fast.holes_filled(), filled);
        }
    }
    set_thread_count(0);
}

// Nothing of a picture is left for the next, of another size or from elsewhere.
TEST(FastWarp, APictureDoesNotDependOnTheOneBefore) {
    const FastField& test = hilly(false);
    Field field = test.field(test.far_options());
    FastWarp used;
    auto all = cameras(test.ground);
    all[2].width_px = 200, all[3].height_px = 300;
    for (size_t n = 0; n < all.size(); ++n) {
        FastWarp fresh;
        FieldList list = list_of(field, all[n]);
        FastOptions options{n % 2 ? Hiding::by_order : Hiding::by_depth};
        Warped picture, expected;
        used.warp(all[n], field, list, test.at_hand(), options, picture, &test.far);
        fresh.warp(all[n], field, list, test.at_hand(), options, expected, &test.far);
        EXPECT_TRUE(picture.colours == expected.colours && picture.depth_m == expected.depth_m) << n;
    }
}

TEST(FastWarp, WhatIsNotAtHandIsCountedAndLeftOut) {
    const FastField& test = hilly(false);
    Field field = test.field(paper_options(test.images));
    view::Camera camera = cameras(test.ground)[0];
    FieldList list = list_of(field, camera);
    FastWarp fast;
    Warped picture;
    WarpCounts none = fast.warp(
        camera, field, list, [](uint64_t) -> const PreparedLdi* { return nullptr; }, {}, picture);
    EXPECT_EQ(none.samples, 0u);
    EXPECT_GT(none.images_missing, 100u);
    EXPECT_EQ(std::count(picture.colours.begin(), picture.colours.end(), 0u), ptrdiff_t(picture.colours.size()));
}

// The same lanes that are drawn, with the same numbers, whichever the processor has.
TEST(FastWarp, LanesBehindTheEyeAreNotDrawn) {
    SampleFrame frame{{-15, -2, -1}, {6, 0, 0.5f}, {0, 40, 0}, {0, 100, 0}, 0.1f, 0.01f,         5, 0.1f,
                      {50, 40},      100,          80,         64,          228,  64 * 228 + 64, 0};
    std::vector<uint32_t> places;
    std::vector<uint16_t> rows(72, 0);
    std::vector<uint8_t> colours(72, 0);
    for (uint32_t s = 0; s < 64 + 8; ++s) places.push_back(s % 64 | (s % 5) << 16);
    for (ProjectSamples project : {&project_samples_anywhere, best_project_samples()})
        for (uint32_t count : {1u, 7u, 8u, 61u}) {
            std::vector<int32_t> pixels(72), sides(72);
            std::vector<float> depths(72);
            ProjectedCounts counts;
            SamplesOfRows samples{places.data(), rows.data(), colours.data(), nullptr, count};
            project(frame, samples, {pixels.data(), sides.data(), depths.data()}, counts);
            uint64_t drawn = 0;
            for (uint32_t s = 0; s < count; ++s) {
                float depth = -1 + (float(s) + 0.5f) * 0.1f * 0.5f;
                bool is_drawn = pixels[s] != frame.nowhere;
                drawn += is_drawn;
                if (is_drawn) {
                    EXPECT_GE(depth, 0.1f);
                    EXPECT_NEAR(depths[s], depth, 1e-6);
                }
            }
            EXPECT_EQ(counts.drawn, drawn);
            if (count == 61) {
                EXPECT_GT(drawn, 5u);
                EXPECT_LT(drawn, 45u);
            }
        }
}

}  // namespace
}  // namespace overlook::wang_ldi
