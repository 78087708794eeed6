// What is listed of a field is all that is in sight, once, and from back to front.
#include "runtime/wang_ldi/field.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "tests/runtime/wang_ldi/field_ground.h"
#include "tests/runtime/wang_ldi/field_parts.h"

namespace overlook::wang_ldi {
namespace {

using Place = std::pair<int64_t, int64_t>;

// Cameras over, between and under the hills, that look anywhere.
view::Camera random_camera(const Ground& ground, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    const Rect& all = ground.extent();
    glm::dvec2 at = all.low_m - 60.0 + (all.high_m - all.low_m + 120.0) * glm::dvec2(unit(random), unit(random));
    double above = unit(random) < 0.5 ? 1.7 : 60 * unit(random) - 10;
    view::Camera camera = head_camera({at, ground.height_m(at) + above}, 360 * unit(random), 100 * unit(random) - 60);
    camera.fov_y_deg = 20 + 90 * unit(random);
    return camera;
}
bool is_seen(const view::Camera& camera, const glm::dvec3& at) {
    view::Axes axes = view::axes_of(camera);
    glm::dvec3 from_eye = at - camera.position_m;
    double depth = glm::dot(axes.forward, from_eye), focal = view::focal_px(camera);
    return depth >= camera.near_m && std::abs(glm::dot(axes.right, from_eye)) * focal <= depth * camera.width_px / 2 &&
           std::abs(glm::dot(axes.up, from_eye)) * focal <= depth * camera.height_px / 2;
}

// Where on a ray from the eye over the ground it is over a convex polygon (counter-clockwise): enters, leaves.
std::pair<double, double> crossing(const glm::dvec2& eye, const glm::dvec2& along, std::span<const glm::dvec2> polygon) {
    double enters = 0, leaves = INFINITY;
    for (size_t c = 0; c < polygon.size(); ++c) {
        glm::dvec2 from = polygon[c], side = polygon[(c + 1) % polygon.size()] - from;
        double inside = side.x * (eye.y - from.y) - side.y * (eye.x - from.x), rate = side.x * along.y - side.y * along.x;
        if (rate > 0) enters = std::max(enters, -inside / rate);
        if (rate < 0) leaves = std::min(leaves, -inside / rate);
        if (rate == 0 && inside < 0) return {0, -1};
    }
    return {enters, leaves};
}
// Footprints of all that is listed, in its order: triangles of tiles, squares of blocks.
std::vector<std::vector<glm::dvec2>> footprints_of(const TestField& test, const FieldList& list) {
    std::vector<std::vector<glm::dvec2>> polygons;
    for (const Item& item : list.items) {
        Rect rect = test.placement->rect_of(item.i, item.j, int64_t(1) << item.tiles_log2);
        if (item.half_count == 0)
            polygons.push_back({rect.low_m, {rect.high_m.x, rect.low_m.y}, rect.high_m, {rect.low_m.x, rect.high_m.y}});
        for (const Half& half : list.halves_of(item)) {
            double piece_m = test.images.tile_m / (1 << item.pieces_log2);
            glm::dvec2 low = rect.low_m + piece_m * glm::dvec2(half.column, half.row), high = low + piece_m;
            glm::dvec2 sw = low, se(high.x, low.y), nw(low.x, high.y), ne = high;
            if (half.diagonal == Diagonal::rising)
                polygons.push_back(half.half == 0 ? std::vector{sw, ne, nw} : std::vector{sw, se, ne});
            else
                polygons.push_back(half.half == 0 ? std::vector{sw, se, nw} : std::vector{se, ne, nw});
        }
    }
    return polygons;
}

// A ray from the eye is over what comes later in the list before it is over what comes earlier, whatever stands there: so nothing
// hides what comes after it.
TEST(Field, NothingIsListedBeforeWhatItHides) {
    TestField test{Ground(hills())};
    FieldOptions options = test.to_horizon(3);
    options.displacement_px = 0.05;
    Field field = test.field(options);
    std::mt19937 random(21);
    std::uniform_real_distribution<double> turn(0, 2 * M_PI);
    uint64_t pairs = 0, halves = 0, blocks = 0;
    for (int view = 0; view < 60; ++view) {
        view::Camera camera = random_camera(test.ground, random);
        FieldList list;
        field.list(camera, list);
        halves += list.halves.size(), blocks += list.counts.blocks_listed;
        auto polygons = footprints_of(test, list);
        for (int ray = 0; ray < 40; ++ray) {
            double heading = turn(random), nearest = INFINITY;
            if (ray % 4) heading = (camera.heading_deg + ray) * M_PI / 180;
            glm::dvec2 along(std::sin(heading), std::cos(heading));
            for (const auto& polygon : polygons) {
                auto [enters, leaves] = crossing(glm::dvec2(camera.position_m), along, polygon);
                if (!(leaves - enters > 1e-7)) continue;
                ASSERT_LE(leaves, nearest + 1e-7) << "view " << view << ", ray " << ray;
                nearest = std::min(nearest, enters), ++pairs;
            }
        }
    }
    EXPECT_GT(pairs, 20000u);
    EXPECT_GT(halves, 20000u);
    EXPECT_GT(blocks, 2000u);
}

TEST(Field, EveryPlantedPlaceInSightIsListedOnce) {
    PlacementOptions planting;
    planting.highest_m = 150, planting.steepest = 0.3;
    TestField test(Ground(hills()), planting);
    Field field = test.field(test.to_horizon());
    std::mt19937 random(22);
    std::uniform_real_distribution<double> unit(0, 1);
    int seen = 0, in_blocks = 0;
    for (int view = 0; view < 40; ++view) {
        view::Camera camera = random_camera(test.ground, random);
        FieldList list;
        field.list(camera, list);
        std::map<Place, int> listed;
        for (const Item& item : list.items)
            for (int64_t n = 0; n < int64_t(1) << (2 * item.tiles_log2); ++n)
                ++listed[{item.i + (n >> item.tiles_log2), item.j + (n & ((1 << item.tiles_log2) - 1))}];
        for (const auto& [place, count] : listed) ASSERT_EQ(count, 1);
        for (int n = 0; n < 4000; ++n) {
            int64_t i = int64_t(600 * unit(random)), j = -int64_t(534 * unit(random));
            Rect rect = test.placement->rect_of(i, j);
            glm::dvec2 at = rect.low_m + 2.0 * glm::dvec2(unit(random), unit(random));
            glm::dvec3 point(at, test.ground.height_m(at) + 1.8 * unit(random));
            if (!test.placement->is_planted(i, j) || !is_seen(camera, point)) continue;
            ASSERT_TRUE(listed.contains({i, j})) << view << ": " << i << " " << j;
            ++seen;
        }
        for (const Item& item : list.items) {
            if (item.tiles_log2 > 0) {
                ++in_blocks;
                int64_t most = int64_t(1) << item.tiles_log2, x = item.i + int64_t(double(most) * unit(random)),
                        y = item.j + int64_t(double(most) * unit(random));
                if (item.is_planted_throughout) {
                    ASSERT_TRUE(test.placement->is_planted(x, y));
                }
            } else {
                ASSERT_TRUE(test.placement->is_planted(item.i, item.j));
                ASSERT_EQ(item.tile, test.tiling->at(item.i, item.j));
            }
        }
    }
    EXPECT_GT(seen, 3000);
    EXPECT_GT(in_blocks, 1000);
}

// All tiles to 40 tiles away, one by one: those of which a place is in the picture are listed, and few others; by the paper's
// rules.
TEST(Field, AsThePaperDrawsIsEveryTileInSightByOneImage) {
    TestField test{Ground::plain()};
    Field field = test.field(paper_options(test.images));
    for (double heading : {0.0, 33.0, 135.0, 290.0}) {
        view::Camera camera = head_camera({1.3, -0.4, 1.7}, heading);
        FieldList list;
        field.list(camera, list);
        std::set<Place> listed;
        for (const Item& item : list.items) {
            listed.insert({item.i, item.j});
            glm::dvec2 middle = test.images.tile_m * (glm::dvec2(item.i, item.j) + 0.5), eye(camera.position_m);
            ASSERT_LE(glm::length(middle - eye), 80.0);
            ASSERT_EQ(item.tiles_log2, 0);
            ASSERT_EQ(item.shown_count, 1u);
            const Shown& shown = list.shown_of(item)[0];
            EXPECT_EQ(shown.by_rung, Thresholds{});
            EXPECT_EQ(shown.by_direction, Thresholds{});
            EXPECT_EQ(which_of(test.images, field.image_of(item, shown)).level,
                      level_for(test.images, glm::length(middle - eye)));
            EXPECT_EQ(shown.direction, direction_for(test.images, eye - middle));
            EXPECT_EQ(item.half_count, 2u);
        }
        size_t in_sight = 0;
        for (int64_t j = -42; j <= 42; ++j)
            for (int64_t i = -42; i <= 42; ++i) {
                glm::dvec2 low = 2.0 * glm::dvec2(i, j);
                if (glm::length(low + 1.0 - glm::dvec2(camera.position_m)) > 80) continue;
                bool is_in_sight = false;
                for (int n = 0; n < 17 * 17 * 3 && !is_in_sight; ++n)
                    is_in_sight = is_seen(camera, {low + glm::dvec2(n % 17, n / 17 % 17) / 8.0, 0.9 * (n / 289)});
                in_sight += is_in_sight;
                if (is_in_sight) {
                    ASSERT_TRUE(listed.contains({i, j})) << i << " " << j;
                }
            }
        EXPECT_GT(in_sight, 1000u);
        EXPECT_LE(listed.size(), in_sight + in_sight / 20);
        EXPECT_EQ(list.counts.tiles_listed, listed.size());
        uint64_t samples = 0;
        for (const Item& item : list.items) samples += test.sample_counts[field.image_of(item, list.shown_of(item)[0])];
        EXPECT_EQ(list.counts.samples, samples);
    }
}

TEST(Field, RefusesPartsThatDoNotBelongTogether) {
    TestField test{Ground::plain()};
    auto message = [&](const FieldParts& parts, const FieldOptions& options) {
        auto made = Field::of(parts, options);
        EXPECT_FALSE(made);
        return made ? "" : made.error().message;
    };
    ImageSet other = test.images;
    other.tile_m = 3;
    FieldParts parts = test.parts();
    parts.images = &other;
    EXPECT_EQ(message(parts, {}), "a field of tiles of 2 m with images of 3 m");
    other = test.images, other.tile_count = 9;
    EXPECT_EQ(message(parts, {}), "a field of 16 tiles with images of 9 tiles, 7 levels, 8 directions");
    parts = test.parts(), parts.sample_counts = parts.sample_counts.subspan(1);
    EXPECT_EQ(message(parts, {}), "a field of 896 images with 895 counts of samples");
    FieldOptions options;
    options.block_share = 0.6;
    EXPECT_EQ(message(test.parts(), options), "a field's blocks of 0.6 of their distance: above 0 and up to 0.5 is needed");
    options = {}, options.ladder.fade_share = NAN;
    message(test.parts(), options);
    options = {}, options.ladder.texel_from_m = 0;
    message(test.parts(), options);
    options = {}, options.most_pieces_log2 = 5;
    message(test.parts(), options);
    options = {}, options.texture_side_px = 0;
    message(test.parts(), options);
    options = {}, options.texture_side_px = 24;
    EXPECT_EQ(message(test.parts(), options), "textures of 24 pixels a side: a power of two up to 4096 is needed");
    options = {}, options.texture_side_px = 16;
    EXPECT_EQ(message(test.parts(), options), "textures of 16 pixels a side with 6 levels");
    options = {}, options.displacement_px = 0;
    message(test.parts(), options);
}

// A plant that leans over its tile's edge into the picture is drawn with its tile, where it is drawn as geometry.
TEST(Field, ListsTilesBesideThePictureWhosePlantsReachIntoIt) {
    TestField test(Ground::plain());
    FieldParts parts = test.parts();
    view::Camera camera = head_camera({1, 1, 1.7}, 37);
    auto listed = [&](double overhang_m, double geometry_to_m) {
        parts.overhang_m = overhang_m;
        auto field = Field::of(parts, test.to_horizon(geometry_to_m));
        EXPECT_TRUE(field);
        std::set<Place> places;
        for (const Item& item : list_of(*field, camera).items)
            if (item.tiles_log2 == 0) places.insert({item.i, item.j});
        return places;
    };
    std::set<Place> without = listed(0, 20), with = listed(0.7, 20);
    EXPECT_TRUE(std::includes(with.begin(), with.end(), without.begin(), without.end()));
    // Tiles of which a place within 0.7 m is in the picture are there, near enough to be geometry.
    int more = 0;
    for (int64_t j = -8; j < 8; ++j)
        for (int64_t i = -8; i < 8; ++i) {
            bool reaches_in = false;
            for (double y = -0.49; y < 2.88; y += 0.1)
                for (double x = -0.49; x < 2.88 && !reaches_in; x += 0.1)
                    for (double z : {0.0, 0.9, 1.7})
                        reaches_in |= is_seen(camera, {2 * double(i) - 0.2 + x, 2 * double(j) - 0.2 + y, z});
            if (!reaches_in || glm::distance(glm::dvec2(1), glm::dvec2(2 * i + 1, 2 * j + 1)) > 14) continue;
            EXPECT_EQ(with.count({i, j}), 1u) << i << " " << j;
            more += without.count({i, j}) == 0;
        }
    EXPECT_GE(more, 1);
    EXPECT_EQ(listed(0.7, 0), listed(0, 0));  // images reach over no edge
    parts.overhang_m = -1;
    EXPECT_FALSE(Field::of(parts, test.to_horizon(20)));
}

}  // namespace
}  // namespace overlook::wang_ldi
