// Far tiles show as much of each texel as its opacity says, cover what is covered, and are the same in blocks and one by one.
#include "runtime/wang_ldi/far_images.h"

#include <gtest/gtest.h>

#include "runtime/wang_ldi/fast_warp.h"
#include "tests/runtime/wang_ldi/field_images.h"

namespace overlook::wang_ldi {
namespace {

const DrawnField& flat() {
    static const DrawnField made(Ground::plain(3));
    return made;
}
const DrawnField& hilly() {
    static const DrawnField made{Ground(hills())};
    return made;
}

// Every texel the same box from 0 to 1 m, of one colour.
TextureSet even_textures(uint32_t side_px, uint8_t opacity) {
    TextureSet set;
    set.side_px = side_px, set.tile_m = 2, set.low_m = 0, set.high_m = 2, set.tile_count = 3, set.direction_count = 4;
    DirectionalTexture texture;
    texture.colours.assign(texture_texels(side_px), {10, 200, 30, opacity});
    texture.heights.assign(texture_texels(side_px), {64, 64});
    set.textures.assign(size_t(set.texture_count()), texture);
    return set;
}
size_t drawn_of(const FarPicture& picture, double share) {
    return size_t(std::count_if(picture.samples.begin(), picture.samples.end(),
                                [&](const FarSample& sample) { return double(sample.needs) < share; }));
}

// A box's face seen from the side is a texel wide and 1 m high: of its points, squares as wide, so many are there that they cover
// as much of it as is opaque.
TEST(FarImages, HaveAsManyPointsAsOpacitySays) {
    for (int share_of_255 : {8, 40, 128, 255}) {
        auto opacity = uint8_t(share_of_255);
        FarImages far(even_textures(32, opacity));
        for (uint32_t direction : {0u, 1u})
            for (uint32_t level : {0u, 1u, 2u}) {
                const FarPicture& picture = far.picture(0, 1, direction, level);
                double texels = picture.side_px * picture.side_px, wide_m = double(picture.wide_m);
                EXPECT_NEAR(wide_m, 2.0 / picture.side_px, 1e-6);
                double wanted = texels * opacity / 255.0 * std::min(1.0, 128.0 / 255 * 2) / wide_m;
                for (double share : {0.25, 1.0})
                    EXPECT_NEAR(double(drawn_of(picture, share)), share * wanted, 2 + 0.06 * share * wanted)
                        << int(opacity) << " " << level;
            }
    }
    EXPECT_TRUE(FarImages().is_empty());
    EXPECT_GT(FarImages(even_textures(32, 40)).bytes(), FarImages(even_textures(16, 40)).bytes());
}

TEST(FarImages, HaveNothingWhereNothingIsSeen) {
    FarImages far(even_textures(16, 0));
    for (uint32_t level = 0; level < 5; ++level) EXPECT_TRUE(far.picture(0, 0, 0, level).samples.empty());
    EXPECT_EQ(far.mean(0, 0, 0).colour, 0u);
}

// Any eight neighbours of a lattice are spread over 0..1 better than at random.
TEST(FarImages, NumbersOfNeighboursAreFarApart) {
    int empty_quarters = 0;
    for (int64_t row = -50; row < 50; ++row)
        for (int64_t column = -50; column < 50; ++column) {
            std::array<int, 4> quarters{};
            for (int64_t n = 0; n < 8; ++n) ++quarters[size_t(4 * spread_at(column + n, row))];
            empty_quarters += int(std::count(quarters.begin(), quarters.end(), 0));
        }
    EXPECT_EQ(empty_quarters, 0);
}

// From files without textures: of the coarsest images, in linear light.
TEST(FarImages, OfImagesAreMeansOfLight) {
    ImageSet set = flat().images;
    Ldi ldi = mounds_image(set, {0, 0, uint32_t(set.levels.size() - 1), 0});
    ldi.palette.assign(15, {0, 255, 100});
    for (size_t s = 0; s < ldi.colours.size(); ++s) ldi.colours[s] = uint8_t(s % 2);
    ldi.palette[1] = {255, 255, 100};
    TextureSet textures =
        textures_of_images(set, [&](uint64_t index) { return which_of(set, index).tile == 2 ? &ldi : nullptr; });
    EXPECT_EQ(textures.side_px, 32u);
    const DirectionalTexture& of_two = textures.textures[size_t(textures.index_of(0, 2, 3))];
    EXPECT_NEAR(int(of_two.colours.back()[0]), 188, 1);
    EXPECT_EQ(of_two.colours.back()[1], 255);
    EXPECT_EQ(of_two.colours.back()[3], 255);
    double sum = 0;
    for (uint16_t step : ldi.heights) sum += set.low_m + step * double(set.levels.back().height_step_m);
    EXPECT_NEAR(textures.height_m(of_two.heights.back()[0]), sum / ldi.sample_count(), (set.high_m - set.low_m) / 255);
    EXPECT_EQ(textures.textures[size_t(textures.index_of(0, 1, 3))].colours.back()[3], 0);
}

// The ground is covered to the horizon, by what stands about as far away as the ground there.
TEST(FarImages, CoverThePlainToTheHorizon) {
    const DrawnField& test = flat();
    FarImages far = test.far();
    FieldOptions options = test.far_options();
    options.ladder.texture_from_m = 20;
    Field field = test.field(options);
    view::Camera camera = head_camera({0.5, 0.5, 8}, 30);
    FieldList list = list_of(field, camera);
    Warped picture = empty_picture(camera);
    WarpCounts counts = warp_field(camera, field, list, test.all(), Hiding::by_depth, picture, &far);
    EXPECT_GT(counts.samples, 10000u);
    view::Axes axes = view::axes_of(camera);
    double focal = view::focal_px(camera);
    size_t ground = 0, holes = 0, off = 0;
    for (uint32_t p = 0; p < picture.colours.size(); ++p) {
        glm::dvec3 along =
            axes.forward + axes.right * ((p % 640 + 0.5 - 320) / focal) + axes.up * ((240 - (p / 640 + 0.5)) / focal);
        if (along.z > -0.01 || along.z < -0.2) continue;
        double t = -5 / along.z;  // to the floor at 3 m
        ++ground, holes += picture.colours[p] == 0;
        off += picture.colours[p] != 0 && (double(picture.depth_m[p]) > 1.15 * t || double(picture.depth_m[p]) < 0.55 * t);
    }
    EXPECT_GT(ground, 30000u);
    EXPECT_LT(double(holes), 0.02 * double(ground));
    EXPECT_LT(double(off), 0.01 * double(ground));
    WarpCounts without = warp_field(camera, field, list, test.all(), Hiding::by_depth, picture);
    EXPECT_LT(without.samples, counts.samples);
}

// Of a block every tile is drawn as if it were listed by itself, wherever rows do not fall on each other.
TEST(FarImages, BlocksAreTheirTiles) {
    const DrawnField& test = hilly();
    FarImages far = test.far();
    FieldOptions blocks = test.far_options(), singles = blocks;
    singles.block_share = 1e-9;
    Field by_blocks = test.field(blocks), by_tiles = test.field(singles);
    for (double heading : {30.0, 200.0}) {
        view::Camera camera = head_camera({503.7, -420.3, test.ground.height_m({503.7, -420.3}) + 30}, heading, -14);
        FieldList of_blocks = list_of(by_blocks, camera), of_tiles = list_of(by_tiles, camera);
        ASSERT_GT(of_blocks.counts.blocks_listed, 3u);
        ASSERT_EQ(of_tiles.counts.blocks_listed, 0u);
        Warped one = empty_picture(camera), other = one;
        warp_field(camera, by_blocks, of_blocks, test.all(), Hiding::by_depth, one, &far);
        warp_field(camera, by_tiles, of_tiles, test.all(), Hiding::by_depth, other, &far);
        size_t differing = 0, shown = 0;
        for (size_t p = 0; p < one.colours.size(); ++p)
            differing += one.colours[p] != other.colours[p], shown += one.colours[p] != 0;
        EXPECT_GT(shown, 60000u);
        EXPECT_LT(double(differing), 0.02 * double(shown)) << heading;
    }
}

// To a thousand tiles as to forty, nearly: what is drawn, not only what is listed.
TEST(FarImages, AThousandTilesTakeNoMoreThanTwiceForty) {
    const DrawnField& test = flat();
    FarImages far = test.far();
    for (double height : {4.8, 9.0}) {
        view::Camera camera = head_camera({0.7, 0.9, height}, 50);
        auto samples_within = [&](double tiles) {
            FieldOptions options = test.far_options();
            options.ladder.radius_m = tiles * test.images.tile_m;
            Field field = test.field(options);
            FieldList list = list_of(field, camera);
            Warped picture = empty_picture(camera);
            return warp_field(camera, field, list, test.all(), Hiding::by_depth, picture, &far).samples;
        };
        uint64_t forty = samples_within(40), thousand = samples_within(1000), horizon = samples_within(1e6);
        EXPECT_LE(thousand, 2 * forty) << height;
        EXPECT_LE(horizon, 3 * forty) << height;
        EXPECT_GT(thousand, forty) << height;
        RecordProperty("forty", std::to_string(forty)), RecordProperty("thousand", std::to_string(thousand));
    }
}

}  // namespace
}  // namespace overlook::wang_ldi
