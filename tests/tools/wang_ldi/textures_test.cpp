// A directional texture has the colours, heights and opacities of what far eyes see, and drawn as boxes it looks the same.
#include "tools/bake/wang_ldi/textures.h"

#include <gtest/gtest.h>

#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/texel_error.h"
#include "tools/bake/wang_ldi/texture_boxes.h"
#include "tools/bake/wang_ldi/texture_sheet.h"
#include "tools/bake/wang_ldi/textures_opacity.h"

namespace overlook::wang_ldi {
namespace {

TraceStage staged(const Models& models, std::vector<rays::Copy> copies) {
    auto stage = stage_of(models, std::move(copies), uint64_t(1) << 32);
    EXPECT_TRUE(stage) << stage.error().message;
    return std::move(*stage);
}
rays::Copy at(uint32_t model, float x, float y) {
    return {model, glm::mat4x3({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, y, 0})};
}
// An upright board along x or y, from z = low to high, of its own colour.
void add_board(Models& models, glm::vec3 along, float low, float high, const glm::vec3& colour) {
    rays::Mesh mesh;
    glm::vec3 up(0, 0, high - low), foot(0, 0, low);
    plants::add_triangle(mesh, foot - along, foot + along, foot + along + up);
    plants::add_triangle(mesh, foot - along, foot + along + up, foot - along + up);
    models.meshes.push_back(std::move(mesh)), models.skins.push_back(plants::skin_of(colour));
}

TextureSet unlit(uint32_t side) {
    ImageSet images = plants::image_set();
    images.has_normals = true, images.direction_count = 16;
    return texture_set_of(images, side);
}

TEST(TextureWalk, PassesEveryTexelOnARayOnceInOrder) {
    Random random(5);
    for (int i = 0; i < 500; ++i) {
        auto unit = [&] { return random.next_unit(); };
        glm::dvec3 from(-3 + 10 * unit(), -3 + 10 * unit(), 2), along(unit() - 0.5, unit() - 0.5, -0.1);
        if (i % 7 == 0) along.x = 0;
        if (i % 11 == 0) along.y = 0;
        glm::dvec2 over = over_tile(from, along, 4);
        double covered = 0, last = over.x;
        if (over.x >= over.y || i % 77 == 0) continue;  // not straight down
        walk_texels(from, along, 4, 8, over.x, over.y, [&](uint32_t texel, double begin, double end) {
            EXPECT_EQ(begin, last);
            glm::dvec3 middle = from + 0.5 * (begin + end) * along;
            if (end - begin > 1e-9) {
                EXPECT_EQ(texel % 8, uint32_t(middle.x / 0.5)) << i;
                EXPECT_EQ(texel / 8, uint32_t(middle.y / 0.5)) << i;
            }
            covered += end - begin, last = end;
            return true;
        });
        EXPECT_NEAR(covered, over.y - over.x, 1e-9) << i;
    }
}

// Two boards that face south, in the south-west and the north-east: each is in its own texels, as high as it is, turned to the
// eye; elsewhere is nothing, and the coarsest texel is the mean of both.
TEST(DirectionalTextures, HaveColourHeightAndNormalOfWhatIsSeen) {
    Models models;
    add_board(models, {0.4f, 0, 0}, 0, 1, {1, 0, 0}), add_board(models, {0.4f, 0, 0}, 0.5f, 1, {0, 0, 1});
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, {at(0, 0.5f, 0.5f), at(1, 3.5f, 3.5f)}));
    TextureSet set = unlit(4);
    DirectionalTexture texture = texture_of(models, stages, set, 8, {}, {}).texture;  // eyes in the south
    EXPECT_EQ(texture.colours[0], (std::array<uint8_t, 4>{255, 0, 0, texture.colours[0][3]}));
    EXPECT_EQ(texture.colours[15], (std::array<uint8_t, 4>{0, 0, 255, texture.colours[15][3]}));
    EXPECT_NEAR(set.height_m(texture.heights[0][0]), 0.5, 0.03);
    EXPECT_NEAR(set.half_height_m(texture.heights[0][1]), 0.5, 0.03);
    EXPECT_NEAR(set.height_m(texture.heights[15][0]), 0.75, 0.03);
    EXPECT_NEAR(set.half_height_m(texture.heights[15][1]), 0.25, 0.03);
    EXPECT_EQ(texture.normals[0], (std::array<int8_t, 3>{0, -127, 0}));
    // Each board is 0.8 of its texel's 1 m wide; lines up to 11 degrees from straight ahead pass some more of the box.
    EXPECT_NEAR(texture.colours[0][3] / 255.0, 0.74, 0.06);
    EXPECT_NEAR(texture.colours[15][3] / 255.0, 0.74, 0.06);
    for (size_t t = 1; t < 15; ++t) EXPECT_EQ(texture.colours[t][3], 0) << t;
    // Twice as much is seen of the one that is twice as high.
    const auto& mean = texture.colours.back();
    EXPECT_NEAR(double(linear_from_srgb(mean[0])), 2 / 3.0, 0.03);
    EXPECT_NEAR(double(linear_from_srgb(mean[2])), 1 / 3.0, 0.03);
    EXPECT_NEAR(set.height_m(texture.heights.back()[0]), (2 * 0.5 + 0.75) / 3, 0.03);
    // What is not seen has the coarser texel's numbers.
    EXPECT_EQ(texture.colours[1][0], texture.colours[0][0]);
    EXPECT_EQ(texture.heights[1], texture.heights[16]);
}

TEST(DirectionalTextures, OfAnEmptyTileAreEmpty) {
    Models models = plants::models();
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, {}));
    TextureSampled all = texture_of(models, stages, unlit(8), 0, {}, {});
    EXPECT_LT(all.eyes, 100u);
    EXPECT_EQ(all.texture.unseen_share, 0);
    for (const auto& colour : all.texture.colours) EXPECT_EQ(colour, (std::array<uint8_t, 4>{}));
}

// Lines straight through one row of three boxes, of which the first shows a half, the second a quarter, the third what is left.
TEST(TextureOpacity, IsWhatShowsEachBoxAsMuchAsIsSeenOfIt) {
    TextureSet set = unlit(4);
    DirectionalTexture texture;
    texture.colours.assign(texture_texels(4), {}), texture.heights.assign(texture_texels(4), {128, 127});
    std::vector<double> shown(texture_texels(4), 0);
    shown[4] = 0.5, shown[5] = 0.25, shown[6] = 0.25;
    std::vector<Line> lines(100, {{-5, 1.5f, 0.5f}, {1, 0, 0}});
    choose_opacity(set, lines, shown, texture);
    EXPECT_NEAR(texture.colours[4][3], 127.5, 1);
    EXPECT_NEAR(texture.colours[5][3], 127.5, 1);
    EXPECT_EQ(texture.colours[6][3], 255);
}

// Drawn, as much of the picture is covered as rays say, in about the same colours; the texture of the opposite direction, which
// shows other sides, is off by more.
TEST(DirectionalTextures, DrawnLookLikeWhatRaysSee) {
    Models models = plants::models();
    add_board(models, {1.8f, 0, 0}, 0, 0.9f, {0.1f, 0.1f, 0.9f});  // in the north of the tile, hidden from there by itself
    std::vector<rays::Copy> copies = copies_of(plants::one_tile(), plants::planting(3), {-1, -1, -1, -1, 0, -1, -1, -1, -1});
    copies.push_back(at(3, 2, 2));
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, copies));
    TextureSet set = texture_set_of(plants::image_set(), 16);
    TextureOptions options;
    options.error_goal = 0.1;
    Judging judging;
    judging.views = 16;
    for (uint32_t direction : {0u, 3u}) {
        DirectionalTexture right = texture_of(models, stages, set, direction, {}, options).texture;
        DirectionalTexture wrong = texture_of(models, stages, set, (direction + 2) % 4, {}, options).texture;
        TextureJudgement of_right = judged_texture(models, stages[0], set, right, direction, 400, {}, judging);
        TextureJudgement of_wrong = judged_texture(models, stages[0], set, wrong, direction, 400, {}, judging);
        ASSERT_GT(of_right.pixels, 200u);
        EXPECT_NEAR(of_right.drawn_coverage, of_right.coverage, 0.1 * of_right.coverage);
        EXPECT_LT(of_right.mean_error, 0.05);
        EXPECT_LT(of_right.mean_error, of_wrong.mean_error);
    }
}

// Linear luma of a finest texel.
double luma_of(const DirectionalTexture& texture, size_t texel) {
    const auto& colour = texture.colours[texel];
    return 0.2126 * double(linear_from_srgb(colour[0])) + 0.7152 * double(linear_from_srgb(colour[1])) +
           0.0722 * double(linear_from_srgb(colour[2]));
}

// How often eyes of the far wedge hit each finest texel.
std::vector<double> hits_of(const TraceStage& stage, const TextureSet& set, uint32_t direction) {
    std::vector<double> hits(size_t(set.side_px) * set.side_px, 0);
    std::vector<rays::Hit> found;
    Eye eye;
    for (uint64_t index = 0; index < 300; ++index) {
        set_eye(far_wedge_of(set, direction), 77, index, 1024, eye);
        found.resize(eye.rays.size());
        stage.scene.first_hits(eye.rays, found);
        for (size_t i = 0; i < found.size(); ++i) {
            if (found[i].copy == rays::kNone) continue;
            glm::dvec3 at = glm::dvec3(eye.rays[i].from_m) + double(found[i].distance) * glm::dvec3(eye.rays[i].along);
            if (at.x < 0 || at.y < 0 || at.x >= set.tile_m || at.y >= set.tile_m) continue;
            double per_m = set.side_px / set.tile_m;
            hits[size_t(at.y * per_m) * set.side_px + size_t(at.x * per_m)] += 1;
        }
    }
    return hits;
}

// Of textures that differ in their seeds alone, finest texels are off their mean by what each states, root mean square over what
// is seen of them.
TEST(DirectionalTextures, AreOffByTheStandardErrorThatTheyState) {
    Models models = plants::models();
    std::vector<rays::Copy> copies = copies_of(plants::one_tile(), plants::planting(3), {0, 0, 0, 0, 0, 0, 0, 0, 0});
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, copies));
    TextureSet set = texture_set_of(plants::image_set(), 8);
    std::vector<double> hits = hits_of(stages[0], set, 1);
    for (double goal : {0.08, 0.03}) {
        std::vector<DirectionalTexture> made;
        double stated_squared = 0;
        TextureOptions options;
        options.error_goal = goal;
        for (options.seed = 1; options.seed <= 12; ++options.seed) {
            made.push_back(texture_of(models, stages, set, 1, {}, options).texture);
            stated_squared += std::pow(double(made.back().standard_error), 2) / 12;
        }
        double off = 0, weights = 0;
        for (size_t texel = 0; texel < 64; ++texel) {
            double mean = 0, squares = 0;
            for (const auto& texture : made) mean += luma_of(texture, texel) / 12;
            for (const auto& texture : made) squares += std::pow(luma_of(texture, texel) - mean, 2) / 11;
            off += hits[texel] * squares, weights += hits[texel];
        }
        double stated = std::sqrt(stated_squared), found = std::sqrt(off / weights);
        EXPECT_NEAR(found, stated, 0.3 * stated) << goal;
    }
}

// Eyes that each see one of two lumas, again and again: the mean of 8 eyes is as uncertain as that of 8 numbers, however often
// each has seen it.
TEST(TexelErrors, AreOfEyesNotOfHits) {
    for (int hits : {1, 100}) {
        TexelErrors errors(3);
        for (uint64_t eye = 0; eye < 8; ++eye)
            for (int hit = 0; hit < hits; ++hit) errors.add(1, eye, eye % 2 == 0 ? 0.25 : 0.75);
        EXPECT_NEAR(errors.standard_error(), 0.25 / std::sqrt(7.0), 1e-9);
        EXPECT_NEAR(errors.luma(), 8 * hits * 0.5, 1e-9);
        // What one eye alone has seen is no surer than the rest.
        for (int hit = 0; hit < hits; ++hit) errors.add(2, 9, 0.5);
        EXPECT_NEAR(errors.standard_error(), 0.25 / std::sqrt(7.0), 1e-9);
    }
    TexelErrors once(1);
    EXPECT_EQ(once.standard_error(), 0);
    once.add(0, 0, 0.5), once.add(0, 0, 0.7);
    EXPECT_TRUE(std::isinf(once.standard_error()));
}

// Where little is seen, boxes are as high as those about them: none is a low opaque speck.
TEST(DirectionalTextures, HaveNoSpecksWhereLittleIsSeen) {
    Models models = plants::models();
    std::vector<TraceStage> stages;
    stages.push_back(staged(models, copies_of(plants::one_tile(), plants::planting(3), {0, 0, 0, 0, 0, 0, 0, 0, 0})));
    TextureSet set = unlit(32);
    TextureOptions options;
    options.most_rays = 20'000;
    DirectionalTexture texture = texture_of(models, stages, set, 3, {}, options).texture;
    int seen = 0, specks = 0;
    for (size_t t = 0; t < 32 * 32; ++t) {
        seen += texture.colours[t][3] > 0;
        specks += texture.colours[t][3] == 255 && texture.heights[t][1] <= 2;
    }
    EXPECT_GT(seen, 100);
    EXPECT_EQ(specks, 0);
}

// One low red box in the south-west: from above it is in the corner, and from each side on its side, at the foot.
TEST(TextureSheet, ShowsBoxesWhereTheyStand) {
    TextureSet set;
    set.side_px = 2, set.tile_m = 4, set.low_m = 0, set.high_m = 2, set.nearest_m = 100, set.farthest_m = 400;
    set.eye_low_m = set.eye_high_m = 1, set.tile_count = 1, set.direction_count = 4;
    DirectionalTexture texture;
    texture.colours.assign(5, {}), texture.heights.assign(5, {0, 0});
    texture.colours[0] = {255, 0, 0, 255}, texture.heights[0] = {32, 31};  // up to half a metre
    set.textures.assign(4, texture);
    auto sheet = sheet_of(set);
    ASSERT_EQ(sheet.size(), 2u);
    auto red_of = [](const ImageRgb8& picture, uint32_t left, uint32_t top, uint32_t width, uint32_t height) {
        uint32_t red = 0;
        for (uint32_t y = top; y < top + height; ++y)
            for (uint32_t x = left; x < left + width; ++x) {
                const uint8_t* pixel = &picture.pixels[3 * (size_t(y) * picture.width + x)];
                red += pixel[0] > 200 && pixel[1] < 50;
            }
        return double(red) / (width * height);
    };
    const ImageRgb8 &above = sheet[0].picture, &aside = sheet[1].picture;
    EXPECT_EQ(above.width, 6 + 4 * 134u);
    EXPECT_EQ(red_of(above, 6, 6 + 64, 64, 64), 1);
    EXPECT_EQ(red_of(above, 6, 6, 128, 128), 0.25);
    ASSERT_EQ(aside.width, 6 + 4 * 198u);
    for (uint32_t direction = 0; direction < 4; ++direction) {  // eyes in the north, east, south, west
        bool is_left = direction == 1 || direction == 2;
        uint32_t left = 6 + 198 * direction;
        EXPECT_GT(red_of(aside, left + (is_left ? 30 : 96), 6 + 95, 66, 20), 0.9) << direction;
        EXPECT_EQ(red_of(aside, left + (is_left ? 100 : 0), 6, 92, 120), 0) << direction;
        EXPECT_EQ(red_of(aside, left, 6, 192, 80), 0) << direction;
    }
    EXPECT_TRUE(sheet_of(TextureSet()).empty());
}

}  // namespace
}  // namespace overlook::wang_ldi
