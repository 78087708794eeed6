// Boxes of a directional texture are as high as shows as much of them to near eyes as to far ones.
#include "tools/bake/wang_ldi/texture_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/texture_boxes.h"
#include "tools/bake/wang_ldi/textures.h"

namespace overlook::wang_ldi {
namespace {

// Sight lines of the eyes of a wedge over its tile.
std::vector<Line> lines_over(const Wedge& wedge) {
    std::vector<Line> lines;
    Eye eye;
    for (uint64_t index = 0; index < 60; ++index) {
        set_eye(wedge, 9, index, 256, eye);
        for (const rays::Ray& ray : eye.rays) {
            glm::dvec2 over = over_tile(glm::dvec3(ray.from_m), glm::dvec3(ray.along), wedge.tile_m);
            if (over.x < over.y) lines.push_back({ray.from_m, ray.along});
        }
    }
    return lines;
}

// What is seen is what boxes of some shape show: that shape is found, and none is looked for where boxes as high as all that is
// seen show it.
TEST(BoxShapes, AreThoseThatCoverNearAndFarAsIsSeen) {
    ImageSet images = plants::image_set();
    images.has_normals = true, images.direction_count = 16;
    TextureSet set = texture_set_of(images, 4);
    set.eye_low_m = 1.5, set.eye_high_m = 1.9, set.nearest_m = 12, set.farthest_m = 48;
    Wedge wedge = far_wedge_of(set, 0);
    std::vector<Line> lines = lines_over(wedge);
    std::vector<double> shown(texture_texels(4), 0);
    for (size_t t = 0; t < 16; ++t) shown[t] = 0.01;
    auto made = [&](const BoxShape& shape) {
        DirectionalTexture texture;
        double middle_m = 0.5 + 0.2 * shape.raised, half_m = 0.2 * shape.half_height, step_m = (set.high_m - set.low_m) / 255;
        texture.colours.assign(texture_texels(4), {});
        texture.heights.assign(texture_texels(4),
                               {uint8_t(std::lround((middle_m - set.low_m) / step_m)), uint8_t(std::lround(half_m / step_m))});
        return texture;
    };
    double even = BoxShape().half_height;
    for (const BoxShape& shape : {BoxShape(), BoxShape{-0.3, 0.4 * even}, BoxShape{0, 0.4 * even}}) {
        DirectionalTexture texture = made(shape);
        choose_opacity(set, lines, shown, texture, 1);
        LinesByDistance truth(wedge);
        for (const Line& line : lines) {
            glm::dvec3 from(line.from_m), along(line.along);
            truth.add(line.from_m, seen_along(set, texture, from, along, over_tile(from, along, set.tile_m)).coverage);
        }
        BoxShape found = chosen_shape(set, wedge, lines, shown, truth, made);
        EXPECT_EQ(found.raised, shape.raised) << shape.half_height;
        EXPECT_EQ(found.half_height, shape.half_height) << shape.raised;
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
