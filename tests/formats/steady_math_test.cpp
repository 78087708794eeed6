// What decides bytes is near the C library's, and is made of what every processor does alike: pinned, bit by bit.
#include "formats/steady_math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "formats/srgb.h"

namespace overlook::steady {
namespace {

TEST(SteadyMath, IsWithinAFewUnitsOfTheLastPlaceOfWhatIsTrue) {
    for (int i = -200000; i <= 200000; ++i) {
        double x = i * 0.00137;
        ASSERT_NEAR(sin(x), std::sin(x), 4e-16) << x;
        ASSERT_NEAR(cos(x), std::cos(x), 4e-16) << x;
        if (std::abs(std::cos(x)) > 0.01) {
            ASSERT_NEAR(tan(x), std::tan(x), 1e-15 * (1 + std::tan(x) * std::tan(x))) << x;
        }
    }
    for (int i = 1; i <= 100000; ++i) {
        double x = i * 0.00071;
        ASSERT_NEAR(log2(x), std::log2(x), 2e-15 * (1 + std::abs(std::log2(x)))) << x;
        ASSERT_NEAR(exp2(x - 30) / std::exp2(x - 30), 1, 2e-15) << x;
        ASSERT_NEAR(pow(x, 2.4) / std::pow(x, 2.4), 1, 2e-14) << x;
    }
    for (double large : {1e6, -1e6, 123456.789}) EXPECT_NEAR(sin(large), std::sin(large), 1e-13);
}

TEST(SteadyMath, IsExactWhereItCanBe) {
    EXPECT_EQ(sin(0), 0);
    EXPECT_EQ(cos(0), 1);
    EXPECT_EQ(tan(0), 0);
    for (int power = -60; power <= 60; ++power) {
        EXPECT_EQ(log2(std::ldexp(1, power)), power);
        EXPECT_EQ(exp2(power), std::ldexp(1, power));
    }
    EXPECT_EQ(pow(0, 2.4), 0);
    EXPECT_EQ(pow(1, 2.4), 1);
    EXPECT_EQ(pow(7, 0), 1);
    EXPECT_TRUE(std::isnan(sin(HUGE_VAL)) && std::isnan(cos(NAN)));
}

// The same bits of any compiler, with any of the C library's variants.
TEST(SteadyMath, HasTheBitsThatItHadElsewhere) {
    uint64_t all = 0;
    auto add = [&](double value) { all = (all ^ std::bit_cast<uint64_t>(value)) * 0x9e3779b97f4a7c15u, all ^= all >> 29; };
    for (int i = 1; i <= 5000; ++i) {
        double x = i * 0.0173;
        add(sin(x)), add(cos(x)), add(tan(x)), add(log2(x)), add(exp2(x / 4)), add(pow(x, 0.37)), add(pow(x, 2.4));
    }
    EXPECT_EQ(all, 17088071428623995757u);
}

TEST(SteadyMath, KeepsEverySrgbCode) {
    for (int code = 0; code < 256; ++code) EXPECT_EQ(std::lround(255 * srgb_from_linear(linear_from_srgb(code / 255.0))), code);
    for (int code = 0; code < 256; ++code) EXPECT_EQ(linear_from_srgb_code(uint8_t(code)), linear_from_srgb(code / 255.0));
}

}  // namespace
}  // namespace overlook::steady
