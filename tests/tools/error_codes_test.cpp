#include "tools/bake/error_codes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/terrain.h"
#include "tests/tools/synthetic_dem.h"

namespace overlook::terrain {
namespace {

// Errors from 1 cm to 2 km, some 0, some infinite.
std::vector<std::vector<float>> random_errors() {
    std::vector<std::vector<float>> errors(3);
    for (size_t level = 0; level < errors.size(); ++level)
        for (uint32_t i = 0; i < 4000; ++i) {
            double share = test::random_share(level, i);
            errors[level].push_back(share < 0.05 ? 0.0f : share > 0.97 ? INFINITY : float(0.01 * std::pow(2e5, share)));
        }
    return errors;
}

TEST(ErrorCodes, NeverLowerAnError) {
    auto errors = random_errors();
    ErrorCodes coded = encode_errors(errors, 1, 0.25);
    for (size_t level = 0; level < errors.size(); ++level)
        for (size_t i = 0; i < errors[level].size(); ++i)
            EXPECT_GE(double(coded.error_m[coded.codes[level][i]]),
                      (errors[level][i] == 0 ? 0 : double(errors[level][i])) + 0.25);
}

TEST(ErrorCodes, KeepTheOrderOfErrors) {
    auto errors = random_errors();
    ErrorCodes coded = encode_errors(errors, 1, 0);
    for (size_t i = 0; i + 1 < errors[0].size(); ++i) {
        bool rises = errors[0][i] <= errors[0][i + 1];
        uint8_t a = coded.codes[0][i], b = coded.codes[0][i + 1];
        EXPECT_TRUE(rises ? a <= b : a >= b) << errors[0][i] << " " << errors[0][i + 1];
    }
    for (size_t code = 1; code < 256; ++code) EXPECT_GE(coded.error_m[code], coded.error_m[code - 1]);
}

TEST(ErrorCodes, RaiseAnErrorByFewPercent) {
    auto errors = random_errors();
    ErrorCodes coded = encode_errors(errors, 1, 0);
    for (size_t i = 0; i < errors[1].size(); ++i)
        EXPECT_LE(coded.error_m[coded.codes[1][i]], errors[1][i] * 1.06f);  // zero and infinity too
}

TEST(ErrorCodes, LoseNothingAtRoundTolerances) {
    auto errors = random_errors();
    ErrorCodes coded = encode_errors(errors, 1, 0);
    for (float tolerance_m : {0.05f, 0.1f, 1.0f, 2.0f, 5.0f, 20.0f, 100.0f, 500.0f})
        for (size_t i = 0; i < errors[2].size(); ++i)
            EXPECT_EQ(coded.error_m[coded.codes[2][i]] <= tolerance_m, errors[2][i] <= tolerance_m)
                << errors[2][i] << " at " << tolerance_m;
}

TEST(ErrorCodes, KeepVoidsAndZeroesApart) {
    ErrorCodes coded = encode_errors({{0, 3, INFINITY}}, 2, 0.5);
    EXPECT_EQ(coded.codes[0][0], 0);
    EXPECT_EQ(coded.error_m[0], 0.5f);
    EXPECT_EQ(coded.error_m[coded.codes[0][1]], 6.5f);
    EXPECT_EQ(coded.codes[0][2], kMustSplit);
    EXPECT_TRUE(std::isinf(coded.error_m[kMustSplit]));
}

TEST(ErrorCodes, OfNothingButZeroesAreZero) {
    ErrorCodes coded = encode_errors({{0, 0, 0}}, 1, 0);
    EXPECT_EQ(coded.codes[0], std::vector<uint8_t>(3, 0));
    EXPECT_EQ(coded.error_m[254], 0);
}

}  // namespace
}  // namespace overlook::terrain
