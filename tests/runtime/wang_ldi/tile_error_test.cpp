// What is predicted of planted ground bounds what samples are displaced by in the picture, and nothing is drawn coarser than
// asked where something finer is there.
#include "runtime/wang_ldi/tile_error.h"

#include <gtest/gtest.h>

#include <random>

#include "runtime/wang_ldi/settings.h"
#include "tests/runtime/wang_ldi/field_ground.h"
#include "tests/runtime/wang_ldi/field_parts.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kTextureSide_px = 32;

FieldOptions options_of(const TestField& test, const view::Camera& camera, double error_px, bool has_geometry) {
    FrameOptions options = defaults_of(Variant::own);
    options.error_px = error_px, options.has_geometry = has_geometry;
    return field_options_of(test.images, options, camera, kTextureSide_px);
}

std::optional<glm::dvec2> seen_px(const view::Camera& camera, const glm::dvec3& at_m) {
    view::Axes axes = view::axes_of(camera);
    glm::dvec3 from = at_m - camera.position_m;
    double depth_m = glm::dot(axes.forward, from);
    if (depth_m < camera.near_m) return std::nullopt;
    glm::dvec2 px = glm::dvec2(glm::dot(axes.right, from), glm::dot(axes.up, from)) * (view::focal_px(camera) / depth_m);
    bool is_in = std::abs(px.x) <= camera.width_px * 0.5 && std::abs(px.y) <= camera.height_px * 0.5;
    return is_in ? std::optional(px) : std::nullopt;
}

// Surfaces anywhere on the tiles listed, as a sample of each image shown has them and on the ground as it is: the greatest
// displacement of those in the picture.
double measured_px(const TestField& test, const Field& field, const FieldList& list, const view::Camera& camera) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    const ImageSet& images = test.images;
    double most = 0;
    for (const Item& item : list.items) {
        glm::dvec2 corner_m = test.placement->rect_of(item.i, item.j).low_m;
        for (const Shown& shown : list.shown_of(item)) {
            const Rung& rung = field.ladder().rungs[shown.rung];
            if (rung.stage != Stage::ldi) continue;
            const Level& level = images.levels[rung.level];
            double pixel_m = images.tile_m / level.side_px, step_m = double(level.height_step_m);
            for (int n = 0; n < 12; ++n) {
                glm::dvec2 in_tile = images.tile_m * glm::dvec2(unit(random), unit(random));
                double up_m = images.low_m + (images.high_m - images.low_m) * unit(random);
                auto true_px = seen_px(camera, {corner_m + in_tile, test.ground.height_m(corner_m + in_tile) + up_m});
                if (!true_px) continue;
                glm::dvec2 sample = (glm::floor(in_tile / pixel_m) + 0.5) * pixel_m, pieces = in_tile / images.tile_m;
                for (const Half& half : list.halves_of(item)) {
                    glm::dvec2 share = pieces * double(1u << item.pieces_log2) - glm::dvec2(half.column, half.row);
                    if (share.x < 0 || share.x >= 1 || share.y < 0 || share.y >= 1) continue;
                    if (half_of(half.diagonal, share.x, share.y) != half.half) continue;
                    // The sample stands on the sheared tile in the middle of its pixel.
                    double ground_m = half.plane.height_m + glm::dot(half.plane.slope, sample);
                    double rounded_m = images.low_m + std::round((up_m - images.low_m) / step_m) * step_m;
                    auto drawn_px = seen_px(camera, {corner_m + sample, ground_m + rounded_m});
                    if (drawn_px) most = std::max(most, glm::length(*drawn_px - *true_px));
                }
            }
        }
    }
    return most;
}

view::Camera standing(const TestField& test, const glm::dvec2& at_m, double heading_deg) {
    return head_camera({at_m, test.ground.height_m(at_m) + 1.7}, heading_deg, -6);
}

TEST(TileError, BoundsWhatSamplesAreDisplacedBy) {
    TestField flat{Ground::plain()}, hilly{Ground(hills())};
    for (const TestField* test : {&flat, &hilly})
        for (double error_px : {0.5, 1.0, 3.0})
            for (bool has_geometry : {true, false}) {
                double measured = 0, predicted = 0;
                for (double heading_deg = 10; heading_deg < 360; heading_deg += 90) {
                    view::Camera camera = standing(*test, {601.3, -533.1}, heading_deg);
                    Field field = test->field(options_of(*test, camera, error_px, has_geometry));
                    FieldList list = list_of(field, camera);
                    double own_px = measured_px(*test, field, list, camera), said_px = planting_error_px(field, list, camera);
                    EXPECT_LE(own_px, said_px * (1 + 1e-9));
                    EXPECT_TRUE(!has_geometry || said_px <= error_px * (1 + 1e-9)) << said_px;
                    measured = std::max(measured, own_px), predicted = std::max(predicted, said_px);
                }
                EXPECT_GT(measured, 0.3 * std::min(predicted, error_px));
            }
}

TEST(TileError, WithoutGeometryIsThatOfTheNearestTiles) {
    TestField test{Ground::plain()};
    view::Camera camera = standing(test, {0.3, 0.4}, 30);
    Field field = test.field(options_of(test, camera, 1, false));
    EXPECT_GT(planting_error_px(field, list_of(field, camera), camera), 10);
}

TEST(TileError, LargerPicturesAreDrawnByFinerImages) {
    TestField test{Ground::plain()};
    view::Camera small = standing(test, {0.3, 0.4}, 30), large = small;
    large.width_px = 1920, large.height_px = 1440;
    Field of_small = test.field(options_of(test, small, 1, true)), of_large = test.field(options_of(test, large, 1, true));
    FieldList few = list_of(of_small, small), many = list_of(of_large, large);
    EXPECT_GT(many.counts.samples, 2 * few.counts.samples);
    auto geometry = [](const Field& field, const FieldList& list) {
        int count = 0;
        for (const Shown& shown : list.shown) count += field.ladder().rungs[shown.rung].stage == Stage::geometry;
        return count;
    };
    EXPECT_GT(geometry(of_large, many), 2 * geometry(of_small, few));
    EXPECT_LE(planting_error_px(of_large, many, large), 1 + 1e-9);
}

// Where a level begins to be shown by its error its share begins at nothing.
TEST(TileError, SharesGrowFromNothingAsTheErrorPermits) {
    TestField test{Ground::plain()};
    Field field = test.field(options_of(test, standing(test, {0.3, 0.4}, 30), 1, true));
    const std::vector<Rung>& rungs = field.ladder().rungs;
    ASSERT_EQ(rungs[0].stage, Stage::geometry);
    for (uint32_t r = 1; r < rungs.size() && rungs[r].stage == Stage::ldi; ++r) {
        double own_m = sample_error_m(test.images, rungs[r].level, 0);
        EXPECT_EQ(rungs_at(field.ladder(), field.farthest_within_m(own_m * (1 - 1e-6))).second, r - 1);
        Mix above = rungs_at(field.ladder(), field.farthest_within_m(own_m * 1.001));
        EXPECT_LE(above.second == r ? above.second_share : 0, kWhole / 4) << r;
    }
    EXPECT_EQ(field.farthest_within_m(0), 0);
    EXPECT_EQ(field.farthest_within_m(1), INFINITY);
}

// Nor does any level come at once, the coarsest of all included.
TEST(TileError, NoLevelComesAtOnceAsTheErrorGrows) {
    TestField test{Ground::plain()};
    Field field = test.field(options_of(test, standing(test, {0.3, 0.4}, 30), 1, true));
    double whole_m = 0;  // from where the coarsest is alone
    for (const Rung& rung : field.ladder().rungs)
        if (rung.stage == Stage::ldi && std::isfinite(rung.from_m)) whole_m = rung.fade_to_m;
    auto place_of = [&](double error_m, double slope) {
        Mix mix = rungs_at(field.ladder(), std::min(whole_m, field.farthest_within_m(error_m, slope)));
        return mix.first + double(mix.second_share) / kWhole;
    };
    for (double slope : {0.0, 0.3}) {
        double before = place_of(0, slope);
        for (double error_m = 1e-4; error_m < 1; error_m *= 1.002) {
            double now = place_of(error_m, slope);
            EXPECT_LE(std::abs(now - before), 0.25) << error_m << " m on a slope of " << slope;
            before = now;
        }
        EXPECT_EQ(before, rungs_at(field.ladder(), whole_m).first);
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
