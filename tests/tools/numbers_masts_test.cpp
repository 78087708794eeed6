#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tools/measure/numbers/masts.h"

namespace overlook::measure {
namespace {

constexpr uint32_t kSide_px = 16, kFactor = 4, kSide = kSide_px * kFactor;

// Green, with an upright red bar; places and widths in samples.
ImageRgb8 bar(uint32_t left, uint32_t width, uint32_t height = kSide, uint8_t red = 200) {
    ImageRgb8 image{kSide, kSide, {}};
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            bool is_bar = x >= left && x < left + width && y < height;
            for (uint8_t channel : {is_bar ? red : uint8_t(90), is_bar ? uint8_t(40) : uint8_t(160), uint8_t(40)})
                image.pixels.push_back(channel);
        }
    return image;
}

TEST(MastLoss, IsNoneOfTheSamePicture) {
    MastLoss loss = mast_loss(bar(30, 3), bar(30, 3), kFactor);
    EXPECT_DOUBLE_EQ(loss.mast_px, 3.0 * kSide / 16);
    EXPECT_EQ(loss.lost_px, 0);
}

TEST(MastLoss, IsAllOfAMastThatIsGoneAndThePartThatIsMissing) {
    MastLoss gone = mast_loss(bar(30, 0), bar(30, 3), kFactor);
    EXPECT_EQ(gone.lost_px, gone.mast_px);
    MastLoss half = mast_loss(bar(30, 3, kSide / 2), bar(30, 3), kFactor);
    EXPECT_DOUBLE_EQ(half.lost_px, half.mast_px * 8 / 16);
    EXPECT_EQ(half.is_lost[size_t(3) * kSide_px + 7], 0);
    EXPECT_EQ(half.is_lost[size_t(12) * kSide_px + 7], 1);
}

TEST(MastLoss, IsNoneWithinAPixelAndAllBeyondThree) {
    EXPECT_EQ(mast_loss(bar(34, 3), bar(30, 3), kFactor).lost_px, 0);
    EXPECT_EQ(mast_loss(bar(26, 3), bar(30, 3), kFactor).lost_px, 0);
    MastLoss far = mast_loss(bar(46, 3), bar(30, 3), kFactor);
    EXPECT_EQ(far.lost_px, far.mast_px);
}

TEST(MastLoss, IsOfMastsThatAreThinnerThanHalf) {
    EXPECT_EQ(mast_loss(bar(30, 4), bar(30, 5), kFactor).lost_px, 0);
    MastLoss thin = mast_loss(bar(30, 2), bar(30, 5), kFactor);
    EXPECT_EQ(thin.lost_px, thin.mast_px);
}

TEST(MastLoss, TellsMastsByTheirRedInLightAndShade) {
    EXPECT_EQ(mast_loss(bar(30, 4, kSide, 100), bar(30, 4), kFactor).lost_px, 0);
    EXPECT_GT(mast_loss(bar(30, 4, kSide, 80), bar(30, 4), kFactor).lost_px, 0);
    EXPECT_TRUE(is_mast_red(50, 24, 24));
    EXPECT_FALSE(is_mast_red(50, 25, 3));
}

TEST(MastSamples, AreSixtyFourAPixelOrSaidToBeFewer) {
    EXPECT_EQ(mast_samples_a_side(2048, 1024), 8u);
    EXPECT_EQ(mast_samples_sentence(2048, 2048), "64 samples a pixel");
    for (auto [width_px, height_px] : {std::pair(2049u, 10u), {10u, 2160u}, {3840u, 2160u}}) {
        EXPECT_EQ(mast_samples_a_side(width_px, height_px), 4u);
        std::string sentence = mast_samples_sentence(width_px, height_px);
        EXPECT_EQ(sentence.rfind("16 samples a pixel, as pictures of more than 2048 pixels a side", 0), 0u) << sentence;
    }
}

}  // namespace
}  // namespace overlook::measure
