// A directional texture has the colours, heights and opacities of what far eyes see, and drawn as boxes it looks the same.
#include "tools/bake/wang_ldi/textures.h"

#include <gtest/gtest.h>

#include "tests/tools/wang_ldi/plants.h"
#include "tools/bake/wang_ldi/texture_walk.h"
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

}  // namespace
}  // namespace overlook::wang_ldi
