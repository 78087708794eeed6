// Correlation and spectrum of tilings whose answer is known.
#include "tools/bake/wang_ldi/periodicity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "runtime/wang_ldi/random.h"
#include "tools/bake/wang_ldi/fourier.h"

namespace overlook::wang_ldi {
namespace {

Tiling tiling_of(uint32_t side, uint8_t (*tile)(uint32_t x, uint32_t y)) {
    Tiling tiling{side, side, {}};
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) tiling.tiles.push_back(tile(x, y));
    return tiling;
}

TEST(Correlation, IsOneOfWhatRepeatsAtALagAndNamesIt) {
    Correlation rows = greatest_correlation(tiling_of(210, [](uint32_t x, uint32_t) { return uint8_t(x % 7); }));
    EXPECT_DOUBLE_EQ(rows.value, 1);
    EXPECT_EQ(rows.x % 7, 0);
    EXPECT_EQ(greatest_correlation(tiling_of(64, [](uint32_t, uint32_t) { return uint8_t(3); })).value, 1);
}

TEST(Correlation, SeesNoLagBelowTheLeast) {
    // The same tile in blocks of two: near neighbours are alike, others are not.
    Tiling tiling = tiling_of(512, [](uint32_t x, uint32_t y) { return uint8_t(below(hash_of(1, 2, x / 2, y / 2), 8)); });
    EXPECT_LE(std::abs(greatest_correlation(tiling, 2, 10).value), 0.02);
    EXPECT_NEAR(greatest_correlation(tiling, 1, 1).value, 0.5, 0.02);
}

TEST(Correlation, IsItsNoiseOfIndependentTiles) {
    Tiling tiling = tiling_of(512, [](uint32_t x, uint32_t y) { return uint8_t(below(hash_of(1, 2, x, y), 8)); });
    double value = std::abs(greatest_correlation(tiling).value);
    EXPECT_LE(value, 6.0 / 512);
    EXPECT_GE(value, 0.1 / 512);
}

TEST(Correlation, IsBelowZeroOfWhatKeepsApart) {
    Correlation apart = greatest_correlation(tiling_of(96, [](uint32_t x, uint32_t) { return uint8_t(x / 2 % 2); }), 2, 2);
    EXPECT_DOUBLE_EQ(apart.value, -1);
}

TEST(Fourier, IsTheSumThatItIs) {
    constexpr uint32_t kSide = 8;
    std::vector<std::complex<double>> values, expected(kSide * kSide);
    for (uint32_t i = 0; i < kSide * kSide; ++i)
        values.emplace_back(double(below(hash_of(3, 0, i, 0), 100)), double(below(hash_of(3, 1, i, 0), 100)));
    for (uint32_t v = 0; v < kSide; ++v)
        for (uint32_t u = 0; u < kSide; ++u)
            for (uint32_t y = 0; y < kSide; ++y)
                for (uint32_t x = 0; x < kSide; ++x)
                    expected[v * kSide + u] +=
                        values[y * kSide + x] * std::polar(1.0, -2 * M_PI * double(u * x + v * y) / double(kSide));
    fourier_2d(values, kSide);
    for (uint32_t i = 0; i < kSide * kSide; ++i) EXPECT_LT(std::abs(values[i] - expected[i]), 1e-9);
}

TEST(Spectrum, HasAPeakWhereATilingRepeatsAndIsFlatWhereItDoesNot) {
    Tiling stripes = tiling_of(64, [](uint32_t x, uint32_t) { return uint8_t(x / 4 % 2); });
    Spectrum spectrum = spectrum_of(stripes, 2, 64);
    SpectrumShape shape = shape_of(spectrum);
    EXPECT_EQ(spectrum.power[8], shape.greatest);  // eight periods across
    EXPECT_NEAR(shape.share_of_top_hundredth, 1, 1e-9);
    Tiling noise = tiling_of(256, [](uint32_t x, uint32_t y) { return uint8_t(below(hash_of(1, 2, x, y), 8)); });
    shape = shape_of(spectrum_of(noise, 8, 256));
    EXPECT_LE(shape.greatest, 8);
    EXPECT_LE(shape.share_of_top_hundredth, 0.03);
}

}  // namespace
}  // namespace overlook::wang_ldi
