#include "tools/measure/error_colours.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/srgb.h"

namespace overlook::measure {
namespace {

constexpr double kDarkest = 0.03, kLightest = 0.97;        // Oklab's lightness
constexpr double kFirstHue_deg = 285, kLastHue_deg = 465;  // violet, by red, to yellow
constexpr double kMostChroma = 0.2;

using Colour = std::array<double, 3>;

Colour linear_from_oklab(double lightness, double a, double b) {
    double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
    double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
    double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
    l = l * l * l;
    m = m * m * m;
    s = s * s * s;
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool is_in_gamut(const Colour& linear) {
    return std::all_of(linear.begin(), linear.end(), [](double channel) { return channel >= -1e-4 && channel <= 1 + 1e-4; });
}

uint8_t encoded(double linear) {
    double c = std::clamp(linear, 0.0, 1.0);
    double srgb = srgb_from_linear(c);
    return uint8_t(std::lround(255 * srgb));
}

}  // namespace

std::array<uint8_t, 3> error_colour(double error) {
    double t = std::isfinite(error) ? std::clamp(error, 0.0, 1.0) : 1;
    double lightness = kDarkest + t * (kLightest - kDarkest);
    double hue = (kFirstHue_deg + t * (kLastHue_deg - kFirstHue_deg)) * std::numbers::pi / 180;
    double chroma = kMostChroma * std::sin(std::numbers::pi * std::min(1.0, t + 0.02));
    Colour linear = linear_from_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
    for (; chroma > 1e-3 && !is_in_gamut(linear); chroma *= 0.998) {
        linear = linear_from_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
    }
    return {encoded(linear[0]), encoded(linear[1]), encoded(linear[2])};
}

ImageRgb8 error_picture(const std::vector<float>& map, uint32_t width, uint32_t height) {
    std::array<std::array<uint8_t, 3>, 256> colours{};
    for (size_t i = 0; i < colours.size(); ++i) colours[i] = error_colour(double(i) / 255);
    ImageRgb8 image{width, height, {}};
    image.pixels.reserve(map.size() * 3);
    for (float error : map) {
        const auto& colour = colours[size_t(std::lround(255 * std::clamp(double(error), 0.0, 1.0)))];
        image.pixels.insert(image.pixels.end(), colour.begin(), colour.end());
    }
    return image;
}

WorstPart worst_part(const std::vector<float>& map, uint32_t width, uint32_t height) {
    static constexpr std::array<const char*, 9> kNames = {"the upper left", "the upper middle", "the upper right",
                                                          "the left",       "the middle",       "the right",
                                                          "the lower left", "the lower middle", "the lower right"};
    std::array<double, 9> sums{};
    double whole = 0;
    for (size_t i = 0; i < map.size(); ++i) {
        size_t part = i / width * 3 / height * 3 + i % width * 3 / width;
        sums[part] += double(map[i]);
        whole += double(map[i]);
    }
    auto greatest = std::max_element(sums.begin(), sums.end());
    return {kNames[size_t(greatest - sums.begin())], whole > 0 ? *greatest / whole : 0};
}

}  // namespace overlook::measure
