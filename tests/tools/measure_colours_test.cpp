// Errors as colours and places, pictures averaged in linear light.
#include "tools/measure/error_colours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tools/measure/capture.h"

namespace overlook::measure {
namespace {

// The light's strength, 0..1.
double luminance(const std::array<uint8_t, 3>& colour) {
    auto linear = [](uint8_t channel) {
        double c = channel / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
}

TEST(ErrorColour, GrowsLighterWithTheError) {
    for (int i = 4; i < 256; ++i) {
        EXPECT_GT(luminance(error_colour(i / 255.0)), luminance(error_colour((i - 4) / 255.0))) << i;
    }
    EXPECT_LT(luminance(error_colour(0)), 0.001);
    EXPECT_GT(luminance(error_colour(1)), 0.85);
}

TEST(ErrorColour, ShowsWhatLiesOutsideAsTheNearerEnd) {
    EXPECT_EQ(error_colour(-3), error_colour(0));
    EXPECT_EQ(error_colour(7), error_colour(1));
    EXPECT_EQ(error_colour(std::numeric_limits<double>::infinity()), error_colour(1));
}

TEST(WorstPart, NamesTheNinthWithMostOfTheError) {
    for (int part = 0; part < 9; ++part) {
        std::vector<float> map(9 * 6, 0.0f);
        map[size_t(part / 3 * 2) * 9 + size_t(part % 3 * 3 + 1)] = 0.9f;
        map[53] += 0.3f;  // the lowest right
        static const char* const kNames[] = {"the upper left", "the upper middle", "the upper right",
                                             "the left",       "the middle",       "the right",
                                             "the lower left", "the lower middle", "the lower right"};
        WorstPart worst = worst_part(map, 9, 6);
        EXPECT_EQ(worst.name, kNames[part]);
        EXPECT_NEAR(worst.share, part == 8 ? 1 : 0.75, 1e-6);
    }
    EXPECT_EQ(worst_part(std::vector<float>(54, 0.0f), 9, 6).share, 0);
}

TEST(BoxFilter, AveragesInLinearLight) {
    // Half black, half white: 0.5 of the light, sRGB 188 (188.03), not 128.
    ImageRgb8 image{4, 4, {}};
    for (int i = 0; i < 16; ++i) image.pixels.insert(image.pixels.end(), 3, i % 2 == 0 ? 0 : 255);
    ImageRgb8 small = box_filtered(image, 4);
    EXPECT_EQ(small.width, 1u);
    EXPECT_EQ(small.pixels, (std::vector<uint8_t>{188, 188, 188}));
}

TEST(BoxFilter, KeepsEveryConstantColour) {
    for (int grey = 0; grey < 256; ++grey) {
        ImageRgb8 small = box_filtered({4, 4, std::vector<uint8_t>(48, uint8_t(grey))}, 2);
        EXPECT_EQ(small.pixels, std::vector<uint8_t>(12, uint8_t(grey)));
    }
}

TEST(BoxFilter, TakesEachBlockFromItsPlace) {
    ImageRgb8 image{4, 2, {}};
    for (int x : {10, 10, 20, 20, 10, 10, 20, 20}) image.pixels.insert(image.pixels.end(), {uint8_t(x), 0, 0});
    EXPECT_EQ(box_filtered(image, 2).pixels, (std::vector<uint8_t>{10, 0, 0, 20, 0, 0}));
}

}  // namespace
}  // namespace overlook::measure
