// What is known of a block of far ground holds at every place of it, so that what it leaves out would not have been drawn.
#include "runtime/wang_ldi/far_view.h"

#include <gtest/gtest.h>

#include "tests/runtime/wang_ldi/field_images.h"

namespace overlook::wang_ldi {
namespace {

const DrawnField& hilly() {
    static const DrawnField made{Ground(hills())};
    return made;
}

struct Checked {
    size_t textures = 0, colours = 0, of_one_direction = 0, of_several = 0;
};

// Every square of a texel's size, or tile, of a block, each as it is chosen and drawn by itself.
void check(const Field& field, const FarView& view, const FarImages& far, const view::Camera& camera, const FarBlock& block,
           int64_t i, int64_t j, uint32_t log2, Checked& checked) {
    const DrawnField& test = hilly();
    const Rung& rung = field.ladder().rungs[block.rung];
    bool is_texture = rung.stage == Stage::texture;
    int64_t side = int64_t(1) << block.tiles_log2, tiles = int64_t(1) << log2;
    ++(is_texture ? checked.textures : checked.colours), ++(block.direction ? checked.of_one_direction : checked.of_several);
    for (int64_t y = j; y < j + tiles; y += side)
        for (int64_t x = i; x < i + tiles; x += side) {
            FarPlace place = view.place_of(x, y, block.tiles_log2);
            ASSERT_FALSE(std::isnan(place.ground_m));
            Chosen exact = field.chosen(glm::dvec2(camera.position_m) - place.middle_m, camera.position_m.z - place.ground_m);
            ASSERT_EQ(exact.rungs, (Mix{block.rung, block.rung, 0}));
            if (block.direction) {
                ASSERT_EQ(exact.directions, (Mix{*block.direction, *block.direction, 0}));
            }
            double rise = view.rise_at(place);
            for (uint32_t direction : {exact.directions.first, exact.directions.second}) {
                double wide_m = place.side_m * far.breadth(direction), shrunk = view.shrunk(wide_m, place);
                double high_m = 2 * double(far.most_half_m()) + kOverlap * place.side_m * rise;
                if (!is_texture) {
                    ASSERT_LE(shrunk, block.share_most);
                    ASSERT_LE(std::min(1.0, high_m / wide_m) * shrunk, block.square_share_most);
                    continue;
                }
                uint32_t level = field.texture_level(rung);
                for (uint32_t tile = 0; tile < test.images.tile_count; ++tile) {
                    const FarPicture& picture = far.picture(0, tile, direction, level);
                    ASSERT_LE(view.share_of(picture, place, rise), block.share_most);
                }
            }
        }
}

TEST(FarBlocks, KnowNothingThatIsNotSoOfAPlace) {
    const DrawnField& test = hilly();
    FarImages far = test.far();
    Checked checked;
    Random random(5);
    for (double direction_fade : {0.0, 0.1, 0.5})
        for (auto [above_m, focal_px] : {std::pair(1.7, 415.7), {40.0, 90.0}, {400.0, 60.0}}) {
            FieldOptions options = options_to_horizon(test.images, focal_px, 0, far.side_px());
            options.direction_fade_share = direction_fade;
            Field field = test.field(options);
            glm::dvec2 at(503.7, -420.3);
            view::Camera camera = head_camera({at, test.ground.height_m(at) + above_m}, 360 * random.next_unit(), -9);
            Eye eye(camera);
            PictureBounds bounds(camera);
            FarView view(eye, bounds, field);
            for (int n = 0; n < 300; ++n) {
                uint32_t log2 = 2 + random.next_below(5);
                int64_t i = int64_t(random.next_below(600u >> log2)) << log2,
                        j = -(int64_t(1 + random.next_below(530u >> log2)) << log2);
                Rect rect = test.placement->rect_of(i, j, int64_t(1) << log2);
                FarBlock block = view.looked_closer({}, rect, test.ground.bound(rect), far);
                if (!block.is_of_one || log2 < block.tiles_log2) continue;
                check(field, view, far, camera, block, i, j, log2, checked);
                // A quarter knows no less, and what it knows is so too.
                if (log2 < block.tiles_log2 + 1) continue;
                Rect quarter = test.placement->rect_of(i, j, int64_t(1) << (log2 - 1));
                FarBlock closer = view.looked_closer(block, quarter, test.ground.bound(quarter), far);
                EXPECT_TRUE(closer.is_of_one && closer.rung == block.rung && (closer.direction || !block.direction));
                check(field, view, far, camera, closer, i, j, log2 - 1, checked);
            }
        }
    EXPECT_GT(checked.textures, 300u);
    EXPECT_GT(checked.colours, 100u);
    EXPECT_GT(checked.of_one_direction, 300u);
    EXPECT_GT(checked.of_several, 100u);
}

TEST(FarImages, SayTheLeastThatAnyPointOfATileNeeds) {
    FarImages far = hilly().far();
    for (uint32_t tile = 0; tile < hilly().images.tile_count; ++tile)
        for (uint32_t level = 0; level < texture_levels(far.side_px()); ++level) {
            float least = std::numeric_limits<float>::infinity();
            for (uint32_t direction = 0; direction < hilly().images.direction_count; ++direction) {
                const FarPicture& picture = far.picture(0, tile, direction, level);
                for (const FarSample& sample : picture.samples) least = std::min(least, sample.needs);
                if (!picture.samples.empty()) {
                    EXPECT_GE(picture.high_m, far.least_high_m(level));
                }
                EXPECT_LE(far.mean(0, tile, direction).half_m, far.most_half_m());
            }
            EXPECT_EQ(far.least_need(tile, level), least);
        }
}

}  // namespace
}  // namespace overlook::wang_ldi
