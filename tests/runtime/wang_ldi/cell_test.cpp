// An image is drawn only for eyes that it was sampled for, fades and all, or the item says that it is not.
#include <gtest/gtest.h>

#include "tests/runtime/wang_ldi/field_ground.h"
#include "tests/runtime/wang_ldi/field_parts.h"

namespace overlook::wang_ldi {
namespace {

// Whether an eye is within an image's own distances and heading, and `level_fade` and `direction_fade` beyond: by degrees.
bool is_own_or_faded(const ImageSet& set, uint32_t level, uint32_t direction, const glm::dvec2& from_middle, double level_fade,
                     double direction_fade) {
    double distance = glm::length(from_middle), begins = double(set.levels[level].nearest_m);
    double ends = level + 1 < set.levels.size() ? double(set.levels[level + 1].nearest_m) : set.cell.farthest_m;
    double heading = std::atan2(from_middle.x, from_middle.y) * 180 / M_PI, step = 360.0 / set.direction_count;
    double off = std::abs(std::remainder(heading - direction * step, 360));
    return distance >= begins * (1 - level_fade) - 1e-5 && distance <= ends * (1 + level_fade) + 1e-5 &&
           off <= (0.5 + direction_fade) * step + 1e-4;
}

struct Seen {
    int inside = 0, outside = 0;
};
// Of all images listed, the items being judged here and by the field.
Seen seen_of(const TestField& test, const Field& field) {
    Seen seen;
    for (double heading = 0; heading < 360; heading += 30) {
        view::Camera camera = head_camera({1.3, -0.4, 1.7}, heading);
        FieldList list = list_of(field, camera);
        uint64_t outside = 0;
        for (const Item& item : list.items) {
            if (item.tiles_log2 > 0) continue;
            glm::dvec2 from_middle = glm::dvec2(camera.position_m) - test.images.tile_m * (glm::dvec2(item.i, item.j) + 0.5);
            bool is_fine = true;
            for (const Shown& shown : list.shown_of(item)) {
                const Rung& rung = field.ladder().rungs[shown.rung];
                if (rung.stage != Stage::ldi) continue;
                is_fine &= is_own_or_faded(test.images, rung.level, shown.direction, from_middle, double(test.images.level_fade),
                                           double(test.images.direction_fade));
            }
            EXPECT_EQ(item.is_outside_cell, !is_fine) << item.i << " " << item.j;
            (is_fine ? seen.inside : seen.outside)++, outside += !is_fine;
        }
        EXPECT_EQ(list.counts.outside_cell, outside);
    }
    return seen;
}

// Tiles of 2 m, images from 1 to 40 m.
FieldOptions near_options(const TestField& test) {
    FieldOptions options = test.to_horizon(1.5);
    options.ladder.texture_from_m = 20;
    return options;
}

TEST(SampledCell, OfImagesSampledForTheFadesHoldsAllThatIsDrawn) {
    TestField test{Ground::plain()};
    test.images.cell.farthest_m = 40, test.images.level_fade = 0.05f, test.images.direction_fade = 0.1f;
    Seen seen = seen_of(test, test.field(near_options(test)));
    EXPECT_GT(seen.inside, 1000);
    EXPECT_EQ(seen.outside, 0);
}

TEST(SampledCell, OfImagesSampledForLessIsLeftWithAWord) {
    TestField test{Ground::plain()};
    test.images.cell.farthest_m = 40;
    Seen unwidened = seen_of(test, test.field(near_options(test)));
    EXPECT_GT(unwidened.outside, 100);
    EXPECT_GT(unwidened.inside, unwidened.outside);
    // Without fades nothing is.
    FieldOptions options = near_options(test);
    options.ladder.fade_share = options.direction_fade_share = 0;
    EXPECT_EQ(seen_of(test, test.field(options)).outside, 0);
    // Half as wide as they are drawn in.
    test.images.level_fade = 0.05f, test.images.direction_fade = 0.05f;
    Seen half = seen_of(test, test.field(near_options(test)));
    EXPECT_GT(half.outside, 30);
    EXPECT_LT(half.outside, unwidened.outside);
}

TEST(SampledCell, IsLeftAboveAndBelowAndNearAndFar) {
    ImageSet set = paper_images(1);
    set.level_fade = 0.125f, set.direction_fade = 0.25f;
    EXPECT_TRUE(is_sampled_for(set, 0, 0, {0, 2}, 1.7));
    EXPECT_FALSE(is_sampled_for(set, 0, 0, {0, 2}, 0.9));
    EXPECT_FALSE(is_sampled_for(set, 0, 0, {0, 2}, 2.6));
    for (double sign : {-1.0, 1.0}) {
        double edge_m = sign < 0 ? set.cell.eye_low_m : set.cell.eye_high_m;
        EXPECT_TRUE(is_sampled_for(set, 0, 0, {0, 2}, edge_m + sign * 5e-7));
        EXPECT_FALSE(is_sampled_for(set, 0, 0, {0, 2}, edge_m + sign * 5e-6));
    }
    EXPECT_TRUE(is_sampled_for(set, 0, 0, {0, 0.876}, 1.7));
    EXPECT_FALSE(is_sampled_for(set, 0, 0, {0, 0.874}, 1.7));
    EXPECT_TRUE(is_sampled_for(set, 6, 4, {0, -16.87}, 1.7));
    EXPECT_FALSE(is_sampled_for(set, 6, 4, {0, -16.88}, 1.7));
    EXPECT_FALSE(is_sampled_for(set, 6, 0, {0, -14}, 1.7));
    auto at = [](double degrees) { return 2.0 * glm::dvec2(std::sin(degrees * M_PI / 180), std::cos(degrees * M_PI / 180)); };
    EXPECT_TRUE(is_sampled_for(set, 0, 0, at(33.7), 1.7));
    EXPECT_TRUE(is_sampled_for(set, 0, 0, at(-33.7), 1.7));
    EXPECT_FALSE(is_sampled_for(set, 0, 0, at(33.8), 1.7));
    EXPECT_FALSE(is_sampled_for(set, 0, 0, at(-33.8), 1.7));
    EXPECT_TRUE(is_sampled_for(set, 0, 7, at(-11.3), 1.7));
    EXPECT_TRUE(is_sampled_for(set, 0, 4, at(-179), 1.7));
}

}  // namespace
}  // namespace overlook::wang_ldi
