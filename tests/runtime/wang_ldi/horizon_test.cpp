// What is said to be hidden by the ground is: a line of sight to any of it, and a little above and beside it, meets the ground
// before.
#include "runtime/wang_ldi/horizon.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/runtime/wang_ldi/field_ground.h"
#include "tests/runtime/wang_ldi/field_parts.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kError_px = 1;

// Whether a line of sight meets the ground before it has gone so far along the ground.
bool meets_ground(const Ground& ground, const glm::dvec3& eye_m, const glm::dvec3& line, double way_m) {
    double level = glm::length(glm::dvec2(line));
    for (double way = 0.25; way < way_m; way += 0.25) {
        glm::dvec3 at_m = eye_m + line * (way / level);
        if (ground.height_m(glm::dvec2(at_m)) > at_m.z) return true;
    }
    return false;
}

// Through a place of the picture, in pixels right and up of its middle.
glm::dvec3 line_through(const view::Camera& camera, const glm::dvec2& at_px) {
    view::Axes axes = view::axes_of(camera);
    return axes.forward + (at_px.x * axes.right + at_px.y * axes.up) / view::focal_px(camera);
}
glm::dvec2 place_px(const view::Camera& camera, const glm::dvec3& at_m) {
    view::Axes axes = view::axes_of(camera);
    glm::dvec3 away = at_m - camera.position_m;
    return glm::dvec2(glm::dot(axes.right, away), glm::dot(axes.up, away)) * view::focal_px(camera) /
           glm::dot(axes.forward, away);
}

struct Asked {
    size_t hidden = 0, all = 0;
};

void check(const Ground& ground, const view::Camera& camera, const Horizon& horizon, std::mt19937& random, Asked& asked) {
    std::uniform_real_distribution<double> unit(0, 1);
    view::Axes axes = view::axes_of(camera);
    double focal_px = view::focal_px(camera);
    Rect rect;
    rect.low_m =
        ground.extent().low_m + (ground.extent().high_m - ground.extent().low_m) * glm::dvec2(unit(random), unit(random));
    double side_m = 2 + 30 * unit(random) * unit(random), wide_m = (asked.all % 4 == 0 ? 12 : 2) * unit(random);
    rect.high_m = glm::min(rect.low_m + side_m, ground.extent().high_m);
    double high_m = ground.range(rect).high_m + 2 * unit(random);
    ++asked.all;
    if (!horizon.hides(rect, high_m, wide_m, kError_px)) return;
    ++asked.hidden;
    for (int n = 0; n < 12; ++n) {
        glm::dvec2 share = n < 4 ? glm::dvec2(n & 1, n >> 1) : glm::dvec2(unit(random), unit(random));
        glm::dvec3 at_m(rect.low_m + (rect.high_m - rect.low_m) * share, high_m - (n % 3) * unit(random));
        double depth_m = glm::dot(axes.forward, at_m - camera.position_m);
        ASSERT_GT(depth_m, 0);
        // A splat's side is rounded, so is where it begins; a pixel is taken for its middle; the ground is drawn so much lower.
        double half_px = std::max(1.0, std::floor(focal_px * wide_m / depth_m + 0.5)) / 2 + 0.5;
        for (double aside : {-1.0, 0.0, 1.0})
            for (double up : {-1.0, 0.0, 1.0}) {
                glm::dvec2 at_px = place_px(camera, at_m) + half_px * glm::dvec2(aside, up) + glm::dvec2(0, kError_px);
                // Of what is beside or above the picture nothing is asked.
                if (std::abs(at_px.x) > camera.width_px / 2.0 || at_px.y > camera.height_px / 2.0 + kError_px) continue;
                // As far along the ground as it is as deep: a splat is as deep as its middle throughout.
                glm::dvec3 line = line_through(camera, at_px);
                double way_m = depth_m * glm::length(glm::dvec2(line));
                EXPECT_TRUE(meets_ground(ground, camera.position_m, line, way_m))
                    << at_m.x << " " << at_m.y << " " << at_m.z << ": " << at_px.x << " " << at_px.y;
            }
    }
}

TEST(Horizon, HidesNothingThatIsSeen) {
    Ground ground(hills());
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    Asked asked;
    for (double above_m : {1.7, 8.0, 60.0})
        for (double pitch_deg : {-42.0, -25.0, -5.0, 0.0, 12.0})
            for (double fov_deg : {30.0, 60.0}) {
                glm::dvec2 at_m = ground.extent().low_m + (ground.extent().high_m - ground.extent().low_m) *
                                                              (0.1 + 0.8 * glm::dvec2(unit(random), unit(random)));
                view::Camera camera = head_camera({at_m, ground.height_m(at_m) + above_m}, 360 * unit(random), pitch_deg);
                camera.fov_y_deg = fov_deg, camera.width_px = 853;
                Horizon horizon(ground, camera);
                ASSERT_FALSE(horizon.is_empty());
                for (int n = 0; n < 400; ++n) check(ground, camera, horizon, random, asked);
            }
    RecordProperty("hidden", std::to_string(asked.hidden));
    EXPECT_GT(asked.hidden, 500u);  // of 12,000, most of which are behind the eye or beside the picture
}

// Most of what a ridge hides is said to be hidden.
TEST(Horizon, HidesWhatLiesBehindARidge) {
    terrain::Terrain ridge =
        terrain_of(101, 101, 10, 10, [](uint32_t, uint32_t row) { return row >= 40 && row < 43 ? 130.0 : 110.0; });
    Ground ground(ridge);
    view::Camera camera = head_camera({500, -800, 112}, 0, 0);  // looks north, at the ridge from 370 m
    Horizon horizon(ground, camera);
    auto is_hidden = [&](double x_m, double y_m, double high_m) {
        return horizon.hides({{x_m, y_m}, {x_m + 2, y_m + 2}}, high_m, 0.5, kError_px);
    };
    // The line of sight over the ridge rises by 18 m in 370 to 400.
    for (double beyond_m : {50.0, 150.0, 300.0}) {
        double line_m = 112 + 18.0 / 400 * (400 + beyond_m);
        EXPECT_TRUE(is_hidden(500, -400 + beyond_m, line_m - 5)) << beyond_m;
        EXPECT_FALSE(is_hidden(500, -400 + beyond_m, line_m + 2)) << beyond_m;
    }
    EXPECT_FALSE(is_hidden(500, -500, 111));  // before it
    EXPECT_FALSE(is_hidden(500, -900, 111));  // behind the eye
}

TEST(Horizon, HidesNothingWhereTheGroundMayBeSeenThrough) {
    view::Camera camera = head_camera({500, -800, 112}, 0, 0);
    auto at = [](uint32_t row) { return row >= 40 && row < 43 ? 130.0 : 110.0; };
    // A ditch without ground before the ridge, in the west, wherever it is.
    for (uint32_t ditch = 43; ditch < 78; ++ditch) {
        terrain::Terrain torn = terrain_of(
            101, 101, 10, 10, [&](uint32_t column, uint32_t row) { return column < 50 && row == ditch ? double(NAN) : at(row); });
        Ground ground(torn);
        Horizon horizon(ground, camera);
        auto is_hidden = [&](double x_m) { return horizon.hides({{x_m, -300}, {x_m + 2, -298}}, 111, 0.5, kError_px); };
        EXPECT_FALSE(is_hidden(400)) << ditch;
        if (ditch < 60) {  // nearer, the block of cells round the eye has a part of it
            EXPECT_TRUE(is_hidden(850)) << ditch;
        }
    }

    terrain::Terrain ridge = terrain_of(101, 101, 10, 10, [&](uint32_t, uint32_t row) { return at(row); });
    Ground whole(ridge);
    Rect behind{{500, -300}, {502, -298}};
    EXPECT_TRUE(Horizon(whole, camera).hides(behind, 111, 0.5, kError_px));
    EXPECT_FALSE(Horizon(whole, camera).hides(behind, 111, 0.5, 40));  // the ridge may be drawn so much lower
    EXPECT_FALSE(Horizon(whole, camera).hides(behind, 111, 60, kError_px));
    // A ridge that ends at 600 to 610 m, seen from 380 m away: it hides nothing 500 m away from 645 m on, nor splats that reach
    // there.
    terrain::Terrain ending =
        terrain_of(101, 101, 10, 10, [&](uint32_t column, uint32_t row) { return column <= 60 ? at(row) : 110.0; });
    Ground half(ending);
    auto is_wide_hidden = [&](double x_m, double wide_m) {
        return Horizon(half, camera).hides({{x_m, -300}, {x_m + 2, -298}}, 111, wide_m, 0);
    };
    EXPECT_TRUE(is_wide_hidden(610, 0.5) && is_wide_hidden(500, 40));
    EXPECT_FALSE(is_wide_hidden(610, 40) || is_wide_hidden(640, 0.5));
    EXPECT_FALSE(Horizon().hides(behind, 111, 0.5, kError_px));
    view::Camera below = camera, outside = camera, steep = camera;
    below.position_m.z = 105, outside.position_m.x = -5, steep.pitch_deg = -70;
    for (const view::Camera& one : {below, outside, steep}) EXPECT_TRUE(Horizon(whole, one).is_empty());
    EXPECT_TRUE(Horizon(Ground::plain(100), camera).is_empty());
    EXPECT_TRUE(Horizon(whole, camera).is_of(whole, camera));
    EXPECT_FALSE(Horizon(whole, camera).is_of(whole, outside));
    EXPECT_FALSE(Horizon(whole, camera).is_of(half, camera));
}

// A list leaves out what is hidden and nothing else, in its order, by however many threads.
TEST(Horizon, TakesWhatItHidesFromAList) {
    TestField test{Ground(hills())};
    FieldOptions options = test.to_horizon(4);
    options.block_share = 0.02;  // so that single tiles show textures too
    Field all = test.field(options);
    options.ground_error_px = kError_px;
    Field seen = test.field(options);
    FieldScratch scratch;
    uint64_t hidden = 0;
    for (double heading = 0; heading < 360; heading += 30) {
        view::Camera camera = head_camera({601.1, -530.3, test.ground.height_m({601.1, -530.3}) + 1.7}, heading);
        FieldList whole = list_of(all, camera), list = list_of(seen, camera), by_threads;
        seen.list(camera, by_threads, scratch);
        ASSERT_TRUE(list.horizon && !whole.horizon);
        EXPECT_EQ(whole.counts.hidden, 0u);
        EXPECT_EQ(by_threads.counts, list.counts);
        EXPECT_EQ(whole.items.size(), list.items.size() + list.counts.hidden);
        EXPECT_EQ(list.counts.tiles_listed + list.counts.blocks_listed, list.items.size());
        hidden += list.counts.hidden;
        size_t next = 0;
        uint64_t samples = 0;
        for (const Item& item : whole.items) {
            bool is_listed = next < list.items.size() && list.items[next].i == item.i && list.items[next].j == item.j &&
                             list.items[next].tiles_log2 == item.tiles_log2;
            if (!is_listed) continue;
            const Item& same = list.items[next++];
            auto shown = list.shown_of(same), shown_of_all = whole.shown_of(item);
            ASSERT_TRUE(std::equal(shown.begin(), shown.end(), shown_of_all.begin(), shown_of_all.end()));
            ASSERT_LE(same.first_half + same.half_count, list.halves.size());
            auto halves = list.halves_of(same), halves_of_all = whole.halves_of(item);
            ASSERT_TRUE(std::equal(halves.begin(), halves.end(), halves_of_all.begin(), halves_of_all.end(),
                                   [](const Half& a, const Half& b) { return a.plane.height_m == b.plane.height_m; }));
            for (const Shown& one : shown)
                if (seen.ladder().rungs[one.rung].stage == Stage::ldi) samples += test.sample_counts[seen.image_of(same, one)];
        }
        EXPECT_EQ(next, list.items.size());
        EXPECT_EQ(samples, list.counts.samples);
    }
    EXPECT_GT(hidden, 200u);
    options.ground_error_px = -1;
    EXPECT_FALSE(Field::of(test.parts(), options));
}

}  // namespace
}  // namespace overlook::wang_ldi
