// Of a field's list the exact warper draws what single tiles, drawn by themselves, would show; in order as well as by depth; with
// any number of threads.
#include "runtime/wang_ldi/warp_field.h"

#include <gtest/gtest.h>

#include "formats/parallel.h"
#include "tests/runtime/wang_ldi/field_images.h"

namespace overlook::wang_ldi {
namespace {

const DrawnField& flat_field() {
    static const DrawnField field{Ground::plain(3)};
    return field;
}
const DrawnField& hilly_field() {
    static const DrawnField field{Ground(hills())};
    return field;
}
view::Camera on_hills(double heading_deg, double above_m = 1.9) {
    glm::dvec2 at(601.3, -533.1);
    return head_camera({at, hilly_field().ground.height_m(at) + above_m}, heading_deg, -8);
}
size_t shown(const Warped& picture) {
    return picture.colours.size() - size_t(std::count(picture.colours.begin(), picture.colours.end(), 0u));
}

// On flat ground a tile in halves is a tile in one.
TEST(WarpField, OnFlatGroundShowsWhatItsTilesShowByThemselves) {
    const DrawnField& test = flat_field();
    Field field = test.field(paper_options(test.images));
    for (double heading : {10.0, 135.0, 250.0}) {
        view::Camera camera = head_camera({11.3, -7.1, 4.8}, heading);
        FieldList list = list_of(field, camera);
        std::vector<Drawn> drawn;
        for (const Item& item : list.items) {
            const Shown& one = list.shown_of(item)[0];
            drawn.push_back({&test.ldis[field.image_of(item, one)],
                             field.ladder().rungs[one.rung].level,
                             {test.placement->rect_of(item.i, item.j).low_m, 3},
                             {0, 0}});
        }
        for (Hiding hiding : {Hiding::by_order, Hiding::by_depth}) {
            Warped whole = empty_picture(camera), halves = whole;
            warp(camera, test.images, drawn, hiding, whole);
            WarpCounts counts = warp_field(camera, field, list, test.all(), hiding, halves);
            size_t differing = 0;
            for (size_t p = 0; p < whole.colours.size(); ++p) {
                ASSERT_EQ(whole.colours[p] == 0, halves.colours[p] == 0);
                differing += whole.colours[p] != halves.colours[p];
                if (hiding == Hiding::by_depth) {
                    ASSERT_EQ(whole.depth_m[p], halves.depth_m[p]);
                }
            }
            EXPECT_LE(double(differing), 0.002 * double(shown(whole))) << "where splats of the two halves overlap";
            EXPECT_GT(shown(whole), 100000u);
            EXPECT_EQ(counts.images_missing, 0u);
            EXPECT_GT(counts.samples_drawn, counts.samples / 3);
        }
    }
}

// What stands in a tile stands on its half's plane: by depth, each half by itself gives the tile, and nothing of a half is
// missing or there twice.
TEST(WarpField, HalvesAreTheTile) {
    const DrawnField& test = hilly_field();
    FieldOptions options = paper_options(test.images);
    options.displacement_px = 0.2, options.most_pieces_log2 = 2, options.chooses_diagonals = true;
    Field field = test.field(options);
    view::Camera camera = on_hills(40, 30);
    camera.pitch_deg = -60;
    FieldList list = list_of(field, camera);
    ASSERT_GT(list.counts.cut_tiles, 10u);
    uint64_t in_whole = 0, in_halves = 0;
    for (const Item& item : list.items) {
        const Shown& one = list.shown_of(item)[0];
        FieldList single;
        single.items = {item}, single.shown = {one};
        single.items[0].first_shown = 0, single.items[0].first_half = 0, single.items[0].half_count = 1;
        Warped whole = empty_picture(camera);
        in_whole = in_halves = 0;
        for (const Half& half : list.halves_of(item)) {
            single.halves = {half};
            in_halves += warp_field(camera, field, single, test.all(), Hiding::by_depth, whole).samples;
        }
        in_whole = test.sample_counts[field.image_of(item, one)];
        if (in_halves == 0) continue;  // outside of the picture
        ASSERT_EQ(in_halves, in_whole);
        Warped at_once = empty_picture(camera);
        single.halves.assign(list.halves_of(item).begin(), list.halves_of(item).end());
        single.items[0].half_count = item.half_count;
        warp_field(camera, field, single, test.all(), Hiding::by_depth, at_once);
        ASSERT_TRUE(at_once.depth_m == whole.depth_m);
    }
}

// Back to front by columns is as good as by depth: mounds are convex, so that only splats of neighbours compete.
TEST(WarpField, InOrderIsAsGoodAsByDepth) {
    const DrawnField& test = hilly_field();
    for (bool fades : {false, true}) {
        FieldOptions options = fades ? test.far_options() : paper_options(test.images);
        Field field = test.field(options);
        FarImages far = test.far();
        size_t seen = 0, behind = 0;
        for (double heading = 0; heading < 360; heading += 90) {
            view::Camera camera = on_hills(heading);
            FieldList list = list_of(field, camera);
            Warped by_order = empty_picture(camera), by_depth = by_order;
            WarpCounts ordered = warp_field(camera, field, list, test.all(), Hiding::by_order, by_order, &far);
            WarpCounts deep = warp_field(camera, field, list, test.all(), Hiding::by_depth, by_depth, &far);
            EXPECT_TRUE(ordered == deep);
            for (size_t p = 0; p < by_order.colours.size(); ++p) {
                ASSERT_EQ(by_order.colours[p] == 0, by_depth.colours[p] == 0);
                if (by_order.colours[p] == 0) continue;
                double near = double(by_depth.depth_m[p]), pixel_m = test.images.tile_m / test.images.levels.back().side_px;
                if (near > 30) pixel_m = std::max(pixel_m, near / 50);
                ++seen, behind += double(by_order.depth_m[p]) - near > 3 * (1.5 * pixel_m + near / 415.7);
            }
        }
        EXPECT_GT(seen, 200000u);
        EXPECT_LT(double(behind), 0.004 * double(seen)) << behind;
    }
}

TEST(WarpField, AnyNumberOfThreadsDrawsTheSame) {
    const DrawnField& test = hilly_field();
    Field field = test.field(test.far_options());
    FarImages far = test.far();
    view::Camera camera = on_hills(70);
    FieldList list = list_of(field, camera);
    ASSERT_GT(list.counts.blocks_listed, 3u);
    for (Hiding hiding : {Hiding::by_order, Hiding::by_depth}) {
        Warped one = empty_picture(camera);
        set_thread_count(1);
        WarpCounts counts = warp_field(camera, field, list, test.all(), hiding, one, &far);
        for (unsigned threads : {2u, 3u, 8u}) {
            set_thread_count(threads);
            Warped many = empty_picture(camera);
            EXPECT_TRUE(warp_field(camera, field, list, test.all(), hiding, many, &far) == counts);
            EXPECT_TRUE(many.colours == one.colours) << threads;
            EXPECT_TRUE(many.depth_m == one.depth_m) << threads;
        }
    }
    set_thread_count(0);
}

TEST(WarpField, WhatIsNotAtHandIsCountedAndLeftOut) {
    const DrawnField& test = flat_field();
    Field field = test.field(paper_options(test.images));
    view::Camera camera = head_camera({0.5, 0.5, 4.8}, 0);
    FieldList list = list_of(field, camera);
    auto finest_is_missing = [&](uint64_t index) {
        return which_of(test.images, index).level == 0 ? nullptr : &test.ldis[index];
    };
    Warped all = empty_picture(camera), rest = all;
    WarpCounts whole = warp_field(camera, field, list, test.all(), Hiding::by_depth, all);
    WarpCounts without = warp_field(camera, field, list, finest_is_missing, Hiding::by_depth, rest);
    EXPECT_EQ(whole.images_missing, 0u);
    EXPECT_GT(without.images_missing, 5u);
    EXPECT_LT(without.samples, whole.samples);
    for (uint32_t colour : rest.colours) ASSERT_TRUE(colour == 0 || (colour >> 8 & 0xff) > 60) << "of the finest level";
    WarpCounts none = warp_field(
        camera, field, list, [](uint64_t) -> const Ldi* { return nullptr; }, Hiding::by_order, rest);
    EXPECT_EQ(none.samples, 0u);
}

// Skipping what is outside of the picture leaves no splat out that reaches into it.
TEST(WarpField, WhatIsSkippedWasOutside) {
    const DrawnField& test = hilly_field();
    Field field = test.field(test.far_options());
    FarImages far = test.far();
    for (double heading : {20.0, 200.0}) {
        view::Camera wide = on_hills(heading), narrow = wide;
        // The same pixels, 200 of 640 to each side of the middle.
        narrow.width_px = 400;
        FieldList list = list_of(field, wide);
        Warped all = empty_picture(wide), part = empty_picture(narrow);
        WarpCounts of_all = warp_field(wide, field, list, test.all(), Hiding::by_depth, all, &far);
        WarpCounts of_part = warp_field(narrow, field, list, test.all(), Hiding::by_depth, part, &far);
        EXPECT_LT(of_part.samples, of_all.samples);
        size_t differing = 0;
        for (uint32_t y = 0; y < 480; ++y)
            for (uint32_t x = 0; x < 400; ++x) {
                size_t p = size_t(y) * 400 + x, q = size_t(y) * 640 + x + 120;
                differing += part.colours[p] != all.colours[q] || part.depth_m[p] != all.depth_m[q];
            }
        EXPECT_LE(differing, 20u) << "but for rounding";
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
