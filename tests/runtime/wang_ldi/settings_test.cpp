// What people set of planted ground, switched alone, changes what it says and nothing else.
#include "runtime/wang_ldi/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/warp_field.h"
#include "tests/runtime/wang_ldi/field_images.h"

namespace overlook::wang_ldi {
namespace {

const DrawnField& hilly_field() {
    static const DrawnField field{Ground(hills())};
    return field;
}
view::Camera on_hills() {
    glm::dvec2 at(601.3, -533.1);
    return head_camera({at, hilly_field().ground.height_m(at) + 1.9}, 40, -8);
}
FrameOptions with(const char* name, double value) {
    FrameOptions options = defaults_of(Variant::own);
    options.has_geometry = false;
    set(options, name, value);
    return options;
}
FieldOptions field_options(const FrameOptions& options) {
    constexpr uint32_t kTextureSide_px = 32;
    return field_options_of(hilly_field().images, options, on_hills(), kTextureSide_px);
}
FieldList listed(const FrameOptions& options) {
    return list_of(hilly_field().field(field_options(options)), on_hills());
}

TEST(PlantingSettings, SplatsAreAsFineAsTheTargetUnlessSaid) {
    auto width_px = [](FrameOptions options, uint32_t samples) {
        options.samples = samples;
        return warped_camera(options, on_hills()).width_px / on_hills().width_px;
    };
    FrameOptions own = defaults_of(Variant::own);
    EXPECT_EQ(width_px(own, 1), 1u);
    EXPECT_EQ(width_px(own, 4), 2u);
    EXPECT_EQ(width_px(with("splat-samples", 1), 4), 1u);
    EXPECT_EQ(width_px(with("splat-samples", 3), 1), 3u);
    EXPECT_EQ(width_px(with("splat-samples", 2), 4), 2u);
    EXPECT_EQ(width_px(defaults_of(Variant::paper), 4), 1u);
    FrameOptions soft = own;
    soft.samples = 4;
    EXPECT_EQ(warped_camera(soft, on_hills()).height_px, 2 * on_hills().height_px);
    view::Camera large = on_hills();
    large.width_px = 5000;
    EXPECT_EQ(warped_camera(soft, large).width_px, 5000u);
    EXPECT_EQ(warped_camera(soft, large).height_px, large.height_px);
    large.width_px = large.height_px = 2048;  // 2^24 of them
    EXPECT_EQ(warped_camera(soft, large).width_px, 4096u);
    large.height_px += 1;
    EXPECT_EQ(warped_camera(soft, large).width_px, 2048u);
    soft.splat_samples = 4, large.width_px = 1600, large.height_px = 900;
    EXPECT_EQ(warped_camera(soft, large).width_px, 3 * large.width_px);
}

TEST(PlantingSettings, OfOneSampleAPixelTheMiddleOfAPixelIsTheMiddleOfASplatsPixel) {
    for (uint32_t asked : {1u, 2u, 3u, 4u})
        for (uint32_t width_px : {640u, 2100u, 2800u, 5000u}) {
            FrameOptions options = with("splat-samples", asked);
            view::Camera camera = on_hills();
            camera.width_px = width_px;
            uint32_t finer = warped_finer(options, camera);
            EXPECT_EQ(finer % 2, 1u) << asked << " of " << width_px;
            EXPECT_LE(finer, asked);
            EXPECT_EQ(warped_camera(options, camera).width_px, finer * width_px);
        }
    view::Camera wide = on_hills();
    wide.width_px = 2800;
    EXPECT_EQ(warped_finer(with("splat-samples", 3), wide), 1u)
        << "9,600 pixels are too many, and two times lie beside the middle";
}

TEST(PlantingSettings, OfWiderSamplesBeginLevelsNearer) {
    Field one = hilly_field().field(field_options(with("error-px", 1))),
          two = hilly_field().field(field_options(with("error-px", 2)));
    auto level_from = [](const Field& field, uint32_t level) {
        for (const Rung& rung : field.ladder().rungs)
            if (rung.stage == Stage::ldi && rung.level == level) return rung.from_m;
        return -1.0;
    };
    EXPECT_DOUBLE_EQ(level_from(one, 1), 6);
    EXPECT_DOUBLE_EQ(level_from(two, 1), 3);
    EXPECT_DOUBLE_EQ(level_from(two, 2), 5);
    EXPECT_LT(list_of(two, on_hills()).counts.samples, list_of(one, on_hills()).counts.samples);
    EXPECT_GT(listed(with("error-px", 0.5)).counts.samples, list_of(one, on_hills()).counts.samples);
}

TEST(PlantingSettings, WithoutFarNothingIsListedBeyondTheImages) {
    FrameOptions near = with("far", 0);
    double images_to_m = field_options(with("far", 1)).ladder.texture_from_m;
    FieldList all = listed(with("far", 1)), some = listed(near);
    auto farthest = [](const FieldList& list) {
        double most = 0;
        for (const Item& item : list.items) most = std::max(most, item.distance_m);
        return most;
    };
    EXPECT_GT(farthest(all), 2 * images_to_m);
    EXPECT_LE(farthest(some), images_to_m * (1 + near.fade));
    EXPECT_EQ(some.counts.texels, 0u);
    EXPECT_EQ(some.counts.samples, all.counts.samples);
    set(near, "radius-m", 10);
    EXPECT_LE(farthest(listed(near)), 10 * (1 + near.fade));
}

TEST(PlantingSettings, WithoutCutsTilesStandInTheTwoHalvesOfThePaper) {
    FieldList cut = listed(with("cuts", 1)), whole = listed(with("cuts", 0));
    EXPECT_GT(cut.counts.cut_tiles, 0u);
    EXPECT_EQ(whole.counts.cut_tiles, 0u);
    EXPECT_TRUE(std::all_of(whole.halves.begin(), whole.halves.end(),
                            [](const Half& half) { return half.diagonal == Diagonal::rising; }));
    EXPECT_GT(whole.counts.displacement_px, cut.counts.displacement_px);
}

TEST(PlantingSettings, WhatTheGroundHidesIsLeftOutUnlessItMayBeSeenThrough) {
    FrameOptions own = with("ground-hides", 1), through = with("ground-hides", 0), coarse = with("error-px", 3);
    EXPECT_EQ(field_options(own).ground_error_px, own.error_px);
    EXPECT_EQ(field_options(coarse).ground_error_px, 3);
    EXPECT_TRUE(std::isinf(field_options(through).ground_error_px));
    EXPECT_TRUE(std::isinf(field_options(defaults_of(Variant::paper)).ground_error_px));
    EXPECT_GT(listed(own).counts.hidden, 0u);
    EXPECT_EQ(listed(through).counts.hidden, 0u);
    EXPECT_EQ(listed(through).items.size(), listed(own).items.size() + listed(own).counts.hidden);
}

TEST(PlantingSettings, WithoutSlopeSplatsSamplesAreAsWideAsOnFlatGround) {
    auto written = [](double value) {
        Field field = hilly_field().field(field_options(with("slope-splats", value)));
        Warped picture = empty_picture(on_hills());
        WarpCounts counts =
            warp_field(on_hills(), field, list_of(field, on_hills()), hilly_field().all(), Hiding::by_depth, picture);
        return std::pair(counts.samples, counts.pixels_written);
    };
    auto [samples, wide] = written(1);
    auto [same, narrow] = written(0);
    EXPECT_EQ(samples, same);
    EXPECT_GT(wide, narrow);
}

TEST(PlantingSettings, AllHaveTheirDefaultsAndChangeTheOptions) {
    for (Variant variant : {Variant::own, Variant::paper})
        for (const SettingKind& kind : setting_kinds(variant)) {
            FrameOptions options = defaults_of(variant);
            set(options, kind.name, kind.otherwise);
            EXPECT_TRUE(options == defaults_of(variant)) << kind.name;
            set(options, kind.name, kind.otherwise == kind.most ? kind.least : kind.most);
            EXPECT_FALSE(options == defaults_of(variant)) << kind.name;
        }
}

}  // namespace
}  // namespace overlook::wang_ldi
