// The smaller levels of a picture with a mask: as much of them is opaque as of the picture.
#include "runtime/gl/masked_levels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/srgb.h"
#include "runtime/gl/objects.h"
#include "tests/gl/fixture.h"

namespace overlook::gl {
namespace {

// Opaque stripes and dots that cover a share of it, yellow on a black that nobody should see.
ImageRgba8 striped(uint32_t width, uint32_t height, uint32_t period, uint32_t wide) {
    ImageRgba8 image{width, height, std::vector<uint8_t>(4 * size_t(width) * height, 0)};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            if ((x + y / 2) % period >= wide) continue;
            uint8_t* pixel = image.pixels.data() + 4 * (size_t(y) * width + x);
            pixel[0] = 200, pixel[1] = 180, pixel[2] = 20, pixel[3] = 255;
        }
    return image;
}

// Of two neighbours' light the mean, stored as the nearest code.
TEST(MaskedLevels, StoreTheLightThatIsSeen) {
    for (uint32_t one = 0; one < 256; one += 5)
        for (uint32_t other = one; other < 256; ++other) {
            ImageRgba8 image{2, 1, {}};
            for (uint32_t code : {one, other})
                for (uint32_t value : {code, code, code, 255u}) image.pixels.push_back(uint8_t(value));
            std::vector<ImageRgba8> levels = masked_levels(image, 0.5f);
            ASSERT_EQ(levels.size(), 1u);
            float light = 0.5f * float(linear_from_srgb(one / 255.0)) + 0.5f * float(linear_from_srgb(other / 255.0));
            ASSERT_EQ(levels[0].pixels[0], std::lround(255 * srgb_from_linear(double(light)))) << one << " " << other;
        }
}

TEST(MaskedLevels, KeepTheShareThatIsOpaque) {
    for (uint32_t wide : {1u, 2u, 5u, 8u}) {
        ImageRgba8 image = striped(128, 96, 9, wide);
        double wanted = opaque_share(image, 0.5f);
        EXPECT_NEAR(wanted, wide / 9.0, 0.12);
        std::vector<ImageRgba8> levels = masked_levels(image, 0.5f);
        ASSERT_EQ(levels.size(), 7u);
        for (const ImageRgba8& level : levels) {
            // Where there are pixels enough to tell.
            if (level.width * level.height < 100) continue;
            EXPECT_NEAR(opaque_share(level, 0.5f), wanted, 0.06) << wide << ": " << level.width;
        }
    }
}
TEST(MaskedLevels, KeepWhatIsThinWherePlainMeansLoseIt) {
    ImageRgba8 image = striped(128, 128, 9, 2);
    std::vector<ImageRgba8> levels = masked_levels(image, 0.5f);
    // Unscaled, a mean of 2 in 9 is below a half nearly everywhere.
    EXPECT_GT(opaque_share(levels[2], 0.5f), 0.1);
    for (const ImageRgba8& level : levels) EXPECT_GT(opaque_share(level, 0.5f), 0) << level.width;
}
TEST(MaskedLevels, TakeTheirColoursFromWhatIsOpaque) {
    for (const ImageRgba8& level : masked_levels(striped(60, 44, 7, 3), 0.5f))
        for (size_t i = 0; i < level.pixels.size(); i += 4) {
            if (level.pixels[i + 3] == 0) continue;
            EXPECT_NEAR(level.pixels[i], 200, 2);
            EXPECT_NEAR(level.pixels[i + 2], 20, 2);
        }
}
TEST(MaskedLevels, OfAPictureThatIsAllOrNothingAreTheSame) {
    ImageRgba8 all{6, 5, std::vector<uint8_t>(120, 255)}, nothing{6, 5, std::vector<uint8_t>(120, 0)};
    for (const ImageRgba8& level : masked_levels(all, 0.5f)) EXPECT_EQ(opaque_share(level, 0.5f), 1);
    for (const ImageRgba8& level : masked_levels(nothing, 0.5f)) EXPECT_EQ(opaque_share(level, 0.5f), 0);
}
TEST(MaskedLevels, LieInTheTexture) {
    OVERLOOK_NEEDS_SOFTWARE_RENDERER(context);
    ErrorCounter errors;
    ImageRgba8 image = striped(50, 36, 9, 2);
    Result<Texture> texture = make_masked_texture(image, 0.5f);
    ASSERT_TRUE(texture) << texture.error().message;
    GLint level = 0;
    for (const ImageRgba8& wanted : masked_levels(image, 0.5f)) {
        std::vector<uint8_t> pixels(wanted.pixels.size());
        glGetTextureImage(texture->id(), ++level, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(pixels.size()), pixels.data());
        EXPECT_TRUE(pixels == wanted.pixels) << level;
    }
    EXPECT_EQ(errors.count(), 0u) << errors.first();
}

}  // namespace
}  // namespace overlook::gl
