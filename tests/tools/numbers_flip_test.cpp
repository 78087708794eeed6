#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "formats/parallel.h"
#include "tests/tools/numbers_pictures.h"
#include "tools/measure/numbers/flip.h"

namespace overlook::measure {
namespace {

using Colour = std::array<double, 3>;

// FLIP as the paper writes it down, in double: no separated filter, no shortcut.
Colour linear_from_srgb(const Colour& rgb) {
    auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    return {linear(rgb[0]), linear(rgb[1]), linear(rgb[2])};
}
Colour times(const double (&m)[3][3], const Colour& v) {
    Colour product{};
    for (size_t i = 0; i < 3; ++i) product[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return product;
}
constexpr double kXyzOfRgb[3][3] = {
    {0.41239080, 0.35758434, 0.18048079}, {0.21263901, 0.71516868, 0.07219232}, {0.01933082, 0.11919478, 0.95053215}};
constexpr double kRgbOfXyz[3][3] = {
    {3.24096994, -1.53738318, -0.49861076}, {-0.96924364, 1.87596750, 0.04155506}, {0.05563008, -0.20397696, 1.05697151}};
const Colour kWhite = {0.95045593, 1.00000001, 1.08905775};

Colour hunt_lab(const Colour& linear) {
    Colour xyz = times(kXyzOfRgb, linear);
    auto curve = [](double t) { return t > std::pow(6 / 29.0, 3) ? std::cbrt(t) : t / (3 * std::pow(6 / 29.0, 2)) + 4 / 29.0; };
    double fx = curve(xyz[0] / kWhite[0]), fy = curve(xyz[1] / kWhite[1]), fz = curve(xyz[2] / kWhite[2]), l = 116 * fy - 16;
    return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
}
double hyab_power(const Colour& a, const Colour& b) {
    return std::pow(std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), 0.7);
}
double colour_difference(const Colour& linear_a, const Colour& linear_b) {
    double greatest = hyab_power(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), knee = 0.4 * greatest;
    double difference = hyab_power(hunt_lab(linear_a), hunt_lab(linear_b));
    return difference < knee ? 0.95 * difference / knee : 0.95 + 0.05 * (difference - knee) / (greatest - knee);
}

// A picture in YCxCz, filtered at one pixel with any weights in the plane.
struct Opponent {
    int width, height;
    std::vector<Colour> pixels;

    explicit Opponent(const Picture& picture) : width(int(picture.width)), height(int(picture.height)) {
        for (size_t i = 0; i < picture.rgb.size(); i += 3) {
            Colour srgb = {picture.rgb[i] / 255.0, picture.rgb[i + 1] / 255.0, picture.rgb[i + 2] / 255.0};
            Colour xyz = times(kXyzOfRgb, linear_from_srgb(srgb));
            double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
            pixels.push_back({116 * y - 16, 500 * (x - y), 200 * (y - z)});
        }
    }
    // Weights that are positive sum to 1, negative ones to -1.
    double filtered(size_t channel, int x, int y, int radius, const std::function<double(double, double)>& weight,
                    bool lift = false) const {
        double positive = 0, negative = 0, weight_positive = 0, weight_negative = 0;
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx) {
                double w = weight(dx, dy);
                size_t at = size_t(std::clamp(y + dy, 0, height - 1)) * size_t(width) + size_t(std::clamp(x + dx, 0, width - 1));
                double value = lift ? (pixels[at][channel] + 16) / 116 : pixels[at][channel];
                (w > 0 ? positive : negative) += w * value;
                (w > 0 ? weight_positive : weight_negative) += std::abs(w);
            }
        return positive / weight_positive + (weight_negative > 0 ? negative / weight_negative : 0);
    }
};

Colour seen_colour(const Opponent& picture, int x, int y, double ppd) {
    constexpr double kPi = std::numbers::pi;
    constexpr double kA[3][2] = {{1, 0}, {1, 0}, {34.1, 13.5}}, kB[3][2] = {{0.0047, 1e-5}, {0.0053, 1e-5}, {0.04, 0.025}};
    int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * ppd));
    Colour filtered{};
    for (size_t c = 0; c < 3; ++c)
        filtered[c] = picture.filtered(c, x, y, radius, [&](double dx, double dy) {
            double square_deg = (dx * dx + dy * dy) / (ppd * ppd), sum = 0;
            for (int i = 0; i < 2; ++i)
                sum += kA[c][i] * std::sqrt(kPi / kB[c][i]) * std::exp(-kPi * kPi * square_deg / kB[c][i]);
            return sum;
        });
    double lift = (filtered[0] + 16) / 116;
    Colour xyz = {(filtered[1] / 500 + lift) * kWhite[0], lift * kWhite[1], (lift - filtered[2] / 200) * kWhite[2]};
    Colour rgb = times(kRgbOfXyz, xyz);
    for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
    return rgb;
}

double feature(const Opponent& picture, int x, int y, double ppd, bool is_point) {
    double sigma = 0.5 * 0.082 * ppd;
    int radius = int(std::ceil(3 * sigma));
    auto weight = [&](double along, double across) {
        double bell = std::exp(-(along * along + across * across) / (2 * sigma * sigma));
        return is_point ? (along * along / (sigma * sigma) - 1) * bell : -along * bell;
    };
    double right = picture.filtered(
        0, x, y, radius, [&](double dx, double dy) { return weight(dx, dy); }, true);
    double down = picture.filtered(
        0, x, y, radius, [&](double dx, double dy) { return weight(dy, dx); }, true);
    return std::hypot(right, down);
}

double flip_at(const Opponent& a, const Opponent& b, int x, int y, double ppd) {
    double colour = colour_difference(seen_colour(a, x, y, ppd), seen_colour(b, x, y, ppd));
    double edge = std::abs(feature(a, x, y, ppd, false) - feature(b, x, y, ppd, false));
    double point = std::abs(feature(a, x, y, ppd, true) - feature(b, x, y, ppd, true));
    return std::pow(colour, 1 - std::sqrt(std::max(edge, point) / std::numbers::sqrt2));
}

Picture edge_picture(uint32_t at_x) {
    return grey_picture(64, 48, [at_x](uint32_t x, uint32_t) { return x < at_x ? 40 : 200; });
}

TEST(Flip, FindsNoDifferenceBetweenAPictureAndItself) {
    Picture picture = noise_picture(61, 47, 1);
    FlipError error = flip(picture, picture);
    for (float value : error.map) ASSERT_EQ(value, 0);
    EXPECT_EQ(error.mean, 0);
    EXPECT_EQ(error.p99, 0);
    EXPECT_EQ(error.max, 0);
}

TEST(Flip, GivesTheClosedFormForPlainColours) {
    const uint8_t colours[][3] = {{0, 0, 0},   {255, 255, 255}, {128, 128, 128}, {255, 0, 0},
                                  {0, 255, 0}, {0, 0, 255},     {90, 140, 60},   {3, 2, 1}};
    for (const auto& a : colours)
        for (const auto& b : colours) {
            FlipError error = flip(plain_picture(20, 12, a[0], a[1], a[2]), plain_picture(20, 12, b[0], b[1], b[2]));
            double truth = colour_difference(linear_from_srgb({a[0] / 255.0, a[1] / 255.0, a[2] / 255.0}),
                                             linear_from_srgb({b[0] / 255.0, b[1] / 255.0, b[2] / 255.0}));
            for (float value : error.map) ASSERT_NEAR(double(value), truth, 1e-3);
            EXPECT_NEAR(error.mean, truth, 1e-3);
        }
}

TEST(Flip, CallsGreenAgainstBlueTheGreatestDifference) {
    EXPECT_NEAR(flip(plain_picture(9, 9, 0, 255, 0), plain_picture(9, 9, 0, 0, 255)).mean, 1, 1e-5);
    EXPECT_NEAR(flip(plain_picture(9, 9, 0, 0, 0), plain_picture(9, 9, 255, 255, 255)).mean, 0.967, 1e-3);  // 100 of HyAB
}

TEST(Flip, EqualsThePapersFiltersEvaluatedInThePlane) {
    Picture a = noise_picture(23, 17, 5), b = noise_picture(23, 17, 6);
    for (size_t i = 0; i < b.rgb.size() / 2; ++i) b.rgb[i] = uint8_t((3 * a.rgb[i] + b.rgb[i]) / 4);
    Opponent opponent_a(a), opponent_b(b);
    for (double ppd : {12.0, 30.0, 67.0}) {
        FlipError error = flip(a, b, ppd);
        for (uint32_t y = 0; y < a.height; y += 4)
            for (uint32_t x = 0; x < a.width; x += 2)
                ASSERT_NEAR(double(error.map[y * a.width + x]), flip_at(opponent_a, opponent_b, int(x), int(y), ppd), 2e-3)
                    << ppd << " pixels per degree at " << x << ", " << y;
    }
}

TEST(Flip, IsSymmetric) {
    Picture a = noise_picture(50, 30, 2), b = noise_picture(50, 30, 3);
    EXPECT_EQ(flip(a, b).map, flip(b, a).map);
}

TEST(Flip, GrowsWithTheDifference) {
    double before = 0;
    Picture reference = grey_picture(40, 40, [](uint32_t x, uint32_t y) { return int(40 + x + y); });
    for (int more : {1, 2, 4, 8, 16, 32, 64, 128}) {
        double mean =
            flip(grey_picture(40, 40, [more](uint32_t x, uint32_t y) { return int(40 + x + y) + more; }), reference).mean;
        EXPECT_GT(mean, before) << more;
        before = mean;
    }
}

TEST(Flip, GrowsWithTheShiftOfAnEdge) {
    double before = 0;
    for (uint32_t shift : {1u, 2u, 3u, 4u, 6u, 8u, 12u}) {
        double mean = flip(edge_picture(20 + shift), edge_picture(20)).mean;
        EXPECT_GT(mean, before) << shift;
        before = mean;
    }
}

TEST(Flip, SeesLessOfFineNoiseFromFartherAway) {
    Picture noise = noise_picture(64, 64, 9), grey = plain_picture(64, 64, 128, 128, 128);
    EXPECT_LT(flip(noise, grey, 120).mean, flip(noise, grey, 30).mean);
    EXPECT_LT(flip(noise, grey, 30).mean, flip(noise, grey, 8).mean);
}

TEST(Flip, HasTheRightOrderOfMagnitude) {
    Picture grey = plain_picture(64, 64, 128, 128, 128);
    Picture barely = grey_picture(64, 64, [](uint32_t x, uint32_t y) { return 127 + int((x * 7 + y * 13) % 3); });
    EXPECT_LT(flip(barely, grey).mean, 0.03);
    EXPECT_GT(flip(noise_picture(64, 64, 4), grey).mean, 0.3);
}

TEST(Flip, FailsItsGateOnAnOutlineThatIsOnePixelOff) {
    FlipError floor = flip(edge_picture(20), edge_picture(20)), method = flip(edge_picture(21), edge_picture(20));
    EXPECT_GT(method.p99, 1.02 * floor.p99 + 0.2);
    EXPECT_LT(method.mean, 0.1 * method.p99) << "of which the mean shows next to nothing";
}

TEST(Flip, GivesTheSameBitsWithAnyThreadCount) {
    Picture a = noise_picture(129, 65, 7), b = noise_picture(129, 65, 8);
    set_thread_count(1);
    FlipError one = flip(a, b);
    for (unsigned threads : {2u, 3u, 8u}) {
        set_thread_count(threads);
        FlipError many = flip(a, b);
        EXPECT_EQ(many.map, one.map);
        EXPECT_EQ(many.mean, one.mean);
    }
    set_thread_count(0);
}

TEST(Flip, TakesPicturesOfAnyShape) {
    for (auto [width, height] : {std::pair(1u, 1u), {1u, 70u}, {300u, 1u}, {2u, 3u}, {400u, 9u}}) {
        FlipError error = flip(plain_picture(width, height, 255, 255, 255), plain_picture(width, height, 0, 0, 0));
        ASSERT_EQ(error.map.size(), size_t(width) * height);
        EXPECT_NEAR(error.mean, 0.967, 1e-3);
        EXPECT_NEAR(error.max, 0.967, 1e-3);
    }
}

}  // namespace
}  // namespace overlook::measure
