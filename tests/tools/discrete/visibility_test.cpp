// Patterns of visibility are what their names say, and one made for a change of levels lets the picture change less than noise.
#include "tools/bake/discrete/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "formats/parallel.h"
#include "tests/tools/discrete/shapes_for_tests.h"
#include "tools/bake/discrete/from_levels.h"
#include "tools/bake/discrete/visibility_optimised.h"

namespace overlook::discrete {
namespace {

// How often each value is there.
std::array<int, 256> counts_of(const Visibility& visibility) {
    std::array<int, 256> counts{};
    for (uint8_t value : visibility.values) ++counts[value];
    return counts;
}

// Of waves over less than an eighth of the highest frequency: how much they hold, beside an even share.
double low_frequencies(const Visibility& v) {
    double low = 0, all = 0;
    int n = int(v.width), low_count = 0;
    for (int fy = 0; fy < n; ++fy)
        for (int fx = 0; fx < n; ++fx) {
            if (fx == 0 && fy == 0) continue;
            // Rows of one wave are enough to tell: the sum of both axes' projections would hide diagonals.
            int wx = std::min(fx, n - fx), wy = std::min(fy, n - fy);
            bool is_low = wx * wx + wy * wy < 16;
            if (!is_low && (fx * 7 + fy * 3) % 16 != 0) continue;  // a sixteenth of the others
            double re = 0, im = 0;
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    double angle = 2 * std::numbers::pi * (fx * x + fy * y) / n;
                    re += v.values[size_t(y * n + x)] * std::cos(angle), im += v.values[size_t(y * n + x)] * std::sin(angle);
                }
            (is_low ? low : all) += re * re + im * im;
            low_count += is_low;
        }
    double others = (double(n) * n - 1 - low_count) / 16;
    return low / low_count / (all / others);
}

TEST(WhiteNoise, HasEveryValueAboutAsOftenAndFollowsTheSeed) {
    Visibility noise = white_noise({1, 2});
    EXPECT_EQ(noise.width, 64u);
    EXPECT_EQ(noise.period_m, 2);
    for (int count : counts_of(noise)) EXPECT_NEAR(count, 16.5, 15.5);
    EXPECT_EQ(noise, white_noise({1, 2}));
    EXPECT_NE(noise, white_noise({2, 2}));
    EXPECT_GT(low_frequencies(noise), 0.5);
}
TEST(BlueNoise, HasEveryValueEquallyOftenAndNoLowFrequencies) {
    Visibility noise = blue_noise({1, 1});
    for (int count : counts_of(noise)) EXPECT_EQ(count, 16);
    EXPECT_LT(low_frequencies(noise), 0.05);
}
TEST(Checkerboard, ShowsOneColourBeforeTheOther) {
    Visibility board = checkerboard({1, 1});
    auto at = [&](uint32_t x, uint32_t y) { return board.values[y * board.width + x]; };
    for (uint32_t y = 0; y < 64; y += 4)
        for (uint32_t x = 0; x < 64; x += 4) EXPECT_EQ(at(x, y) < 128, (x / 8 + y / 8) % 2 == 0);
}

Chain ball_and(uint32_t levels_by_hand, double second_m) {
    std::vector<mesh::MeshFile> files;
    for (uint32_t k = 0; k < levels_by_hand; ++k) {
        sample::ShapeMaker shapes({mesh::Surface()});
        if (k == 0) test::add_ball(shapes, 0, 48, 64, 1, 0);
        if (k > 0) shapes.add_box(0, {0, 0, 0}, {second_m, 0, 0}, {0, second_m, 0}, {0, 0, second_m}, 1, 1);
        files.push_back(test::file_of(shapes.take()));
    }
    std::vector<MeasuredLevel> measured;
    auto chain = chain_from_levels(files, {}, measured, [](double) {});
    EXPECT_TRUE(chain);
    return chain ? *chain : Chain{};
}

double value_at(const Visibility& v, const glm::dvec3& origin_m, const glm::dvec3& at_m) {
    if (v.lookup == Visibility::Lookup::paper) {
        auto wrap = [](double share, uint32_t n) { return std::min(n - 1, uint32_t((share - std::floor(share)) * n)); };
        uint32_t x = wrap((at_m.x + at_m.z) / v.period_m, v.width), y = wrap((at_m.y + at_m.z) / v.period_m, v.height);
        return v.values[y * v.width + x];
    }
    glm::dvec3 at = (at_m - origin_m) / double(v.period_m) * double(v.width) - 0.5;
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::array<int64_t, 3> cell{};
        for (int axis = 0; axis < 3; ++axis) {
            double low = std::floor(at[axis]), share = at[axis] - low;
            bool is_high = (corner >> axis & 1) != 0;
            weight *= is_high ? share : 1 - share;
            cell[size_t(axis)] = std::clamp<int64_t>(int64_t(low) + is_high, 0, int64_t(v.width) - 1);
        }
        sum += weight * v.values[size_t((cell[2] * v.height + cell[1]) * v.width + cell[0])];
    }
    return sum;
}

TEST(FromCentre, GrowsOutwardsEvenlyInArea) {
    Chain chain = ball_and(2, 0.4);
    Visibility v = from_centre(chain);
    ASSERT_EQ(v.lookup, Visibility::Lookup::volume);
    // The cube's faces are nearer than any of the ball.
    double cube = value_at(v, chain.origin_m, {0.4, 0, 0}), ball = value_at(v, chain.origin_m, {0, 0, 1});
    EXPECT_LT(cube, ball);
    double corner = value_at(v, chain.origin_m, {0.39, 0.39, 0.39});
    EXPECT_LT(cube, corner);
}
TEST(Visibility, IsSetByNameForAllChangesOrForEach) {
    Chain chain = ball_and(3, 0.8);
    for (const char* name : {"noise", "blue-noise", "checkerboard", "centre"}) {
        ASSERT_TRUE(set_visibility(chain, name, {}));
        EXPECT_EQ(chain.visibility.size(), 1u) << name;
    }
    ASSERT_TRUE(set_visibility(chain, "optimised", {}));
    EXPECT_EQ(chain.visibility.size(), 2u);
    ASSERT_TRUE(set_visibility(chain, "none", {}));
    EXPECT_TRUE(chain.visibility.empty());
    auto missing = set_visibility(chain, "missing.png", {});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().exit, Exit::bad_input);
}

// A ball and a cube seen along y by parallel rays; what is hit first, if what hits it is to be seen.
std::optional<glm::dvec3> on_ball(double x, double z) {
    double inside = 1 - x * x - z * z;
    if (inside <= 0) return std::nullopt;
    return glm::dvec3(x, -std::sqrt(inside), z);
}
std::optional<glm::dvec3> on_cube(double half, const glm::dmat2& turn, double x, double z) {
    // Turned about z: the ray's two crossings with each pair of sides.
    glm::dvec2 from = glm::transpose(turn) * glm::dvec2(x, -5), along = glm::transpose(turn) * glm::dvec2(0, 1);
    if (std::abs(z) > half) return std::nullopt;
    double enter = -1e9, leave = 1e9;
    for (int axis = 0; axis < 2; ++axis) {
        double a = (-half - from[axis]) / along[axis], b = (half - from[axis]) / along[axis];
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave) return std::nullopt;
    glm::dvec2 at = from + enter * along;
    return glm::dvec3(at.x, at.y, z);
}

// The integrated temporal residual (mean over pixels of how far the change from frame to frame is from that of the ball alone,
// summed) of a change from the ball to the cube, each visible by the paper's function (figure 2), the camera drifting by a third
// of a pixel a frame.
double integrated_residual(const Chain& chain, const Visibility& visibility) {
    constexpr int kSide = 96, kFrames = 60;
    constexpr double kHalf = 0.8, kPixel = 2.6 / kSide;
    double angle = 0.6;
    glm::dmat2 turn(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
    std::vector<double> before, ball_before;
    double sum = 0;
    for (int frame = 0; frame <= kFrames; ++frame) {
        double share = double(frame) / kFrames, of_cube = std::min(1.0, 2 * share), of_ball = std::min(1.0, 2 - 2 * share);
        std::vector<double> picture, ball_picture;
        for (int row = 0; row < kSide; ++row)
            for (int column = 0; column < kSide; ++column) {
                double x = (column - kSide / 2 + 0.5 + frame / 3.0 - kFrames / 6.0) * kPixel,
                       z = (row - kSide / 2 + 0.5) * kPixel;
                auto ball = on_ball(x, z), cube = on_cube(kHalf, turn, x, z);
                auto seen = [&](const std::optional<glm::dvec3>& at, double visible) {
                    return at && value_at(visibility, chain.origin_m, *at) < 256 * visible;
                };
                bool sees_ball = seen(ball, of_ball), sees_cube = seen(cube, of_cube);
                picture.push_back(sees_ball && sees_cube ? 0.65 : sees_ball ? 0.9 : sees_cube ? 0.4 : 0.1);
                ball_picture.push_back(ball ? 0.9 : 0.1);
            }
        if (frame > 0)
            for (size_t i = 0; i < picture.size(); ++i)
                sum += std::abs((picture[i] - before[i]) - (ball_picture[i] - ball_before[i])) / double(picture.size());
        before = std::move(picture), ball_before = std::move(ball_picture);
    }
    return sum;
}

TEST(OptimisedVisibility, LeavesAtLeastThirtyPercentLessResidualThanWhiteNoise) {
    Chain chain = ball_and(2, 0.8);
    double noise = 0;
    for (uint64_t seed : {1, 2, 3}) noise += integrated_residual(chain, white_noise({seed, 1})) / 3;
    double optimised = integrated_residual(chain, optimised_visibility(chain, 0));
    RecordProperty("white_noise", std::to_string(noise));
    RecordProperty("optimised", std::to_string(optimised));
    std::printf("integrated residual: white noise %.4f, blue noise %.4f, centre %.4f, optimised %.4f\n", noise,
                integrated_residual(chain, blue_noise({1, 1})), integrated_residual(chain, from_centre(chain)), optimised);
    EXPECT_LT(optimised, 0.7 * noise);
}
TEST(OptimisedVisibility, IsTheSameForAnyNumberOfThreads) {
    Chain chain = ball_and(2, 0.8);
    set_thread_count(1);
    Visibility one = optimised_visibility(chain, 0);
    set_thread_count(4);
    Visibility four = optimised_visibility(chain, 0);
    set_thread_count(0);
    EXPECT_EQ(one, four);
}

}  // namespace
}  // namespace overlook::discrete
