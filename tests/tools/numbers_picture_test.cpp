#include <gtest/gtest.h>

#include <cmath>

#include "tests/tools/numbers_pictures.h"

namespace overlook::measure {
namespace {

TEST(PictureNumbers, WeighTheChannelsOfLumaByRec709) {
    EXPECT_FLOAT_EQ(luma_of(plain_picture(1, 1, 255, 0, 0))[0], 0.2126f);
    EXPECT_FLOAT_EQ(luma_of(plain_picture(1, 1, 0, 255, 0))[0], 0.7152f);
    EXPECT_FLOAT_EQ(luma_of(plain_picture(1, 1, 0, 0, 255))[0], 0.0722f);
    EXPECT_FLOAT_EQ(luma_of(plain_picture(1, 1, 51, 51, 51))[0], 0.2f);
}

TEST(PictureNumbers, AreNothingAndInfinityForTheSamePicture) {
    Picture picture = noise_picture(33, 21, 1);
    EXPECT_EQ(luma_difference_mean(picture, picture), 0);
    EXPECT_TRUE(std::isinf(psnr_db(picture, picture)));
}

TEST(PictureNumbers, AreOneAndNoDecibelForBlackAgainstWhite) {
    Picture black = plain_picture(7, 5, 0, 0, 0), white = plain_picture(7, 5, 255, 255, 255);
    EXPECT_NEAR(luma_difference_mean(black, white), 1, 1e-6);
    EXPECT_DOUBLE_EQ(psnr_db(black, white), 0);
}

TEST(PictureNumbers, KnowAQuarterOfThePixelsOffByAFifth) {
    Picture plain = grey_picture(8, 8, [](uint32_t, uint32_t) { return 100; });
    Picture spotted = grey_picture(8, 8, [](uint32_t x, uint32_t y) { return x % 2 && y % 2 ? 151 : 100; });
    EXPECT_NEAR(luma_difference_mean(spotted, plain), 0.05, 1e-6);
    EXPECT_NEAR(psnr_db(spotted, plain), 20, 1e-9);  // mean square 0.2^2 / 4 = 0.01
}

TEST(PictureNumbers, AreWorseForAWorsePicture) {
    Picture plain = plain_picture(16, 16, 90, 120, 60), off = plain_picture(16, 16, 92, 120, 60),
            more = plain_picture(16, 16, 99, 120, 60);
    EXPECT_GT(luma_difference_mean(more, plain), luma_difference_mean(off, plain));
    EXPECT_LT(psnr_db(more, plain), psnr_db(off, plain));
}

}  // namespace
}  // namespace overlook::measure
