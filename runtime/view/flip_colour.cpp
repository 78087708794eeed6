#include "runtime/view/flip_colour.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "formats/srgb.h"

namespace overlook::view {
namespace {

// IEC 61966-2-1 linear RGB to CIE XYZ; the white is its image of (1, 1, 1).
constexpr float kXyzFromRgb[3][3] = {
    {0.4124564f, 0.3575761f, 0.1804375f}, {0.2126729f, 0.7151522f, 0.0721750f}, {0.0193339f, 0.1191920f, 0.9503041f}};
constexpr float kWhite[3] = {kXyzFromRgb[0][0] + kXyzFromRgb[0][1] + kXyzFromRgb[0][2],
                             kXyzFromRgb[1][0] + kXyzFromRgb[1][1] + kXyzFromRgb[1][2],
                             kXyzFromRgb[2][0] + kXyzFromRgb[2][1] + kXyzFromRgb[2][2]};
constexpr float kRgbFromXyz[3][3] = {
    {3.2404542f, -1.5371385f, -0.4985314f}, {-0.9692660f, 1.8760108f, 0.0415560f}, {0.0556434f, -0.2040259f, 1.0572252f}};

constexpr float kExponent = 0.7f;        // qc
constexpr float kKneeOfGreatest = 0.4f;  // pc
constexpr float kKneeTo = 0.95f;         // pt

// XYZ relative to the white.
struct Relative {
    float x, y, z;
};

inline Relative relative_from_rgb(float r, float g, float b) {
    auto row = [&](int i) { return (kXyzFromRgb[i][0] * r + kXyzFromRgb[i][1] * g + kXyzFromRgb[i][2] * b) * (1 / kWhite[i]); };
    return {row(0), row(1), row(2)};
}

// Of 0..1, to a rounding of float: a guess from the exponent's bits, two steps of Halley. A fraction of std::cbrt's time, and the
// same bits from any mathematical library.
inline float cube_root(float value) {
    int32_t bits = int32_t(float(std::bit_cast<int32_t>(value)) * (1 / 3.0f)) + 709921077;
    float root = std::bit_cast<float>(bits);
    for (int step = 0; step < 2; ++step) {
        float cube = root * root * root;
        root = root * ((cube + value + value) / (cube + cube + value));
    }
    return root;
}

inline float lab_curve(float t) {
    constexpr float kDelta = 6 / 29.0f;
    float straight = t * (1 / (3 * kDelta * kDelta)) + 4 / 29.0f, root = cube_root(t);
    return t > kDelta * kDelta * kDelta ? root : straight;
}

struct Hunt {
    float l, a, b;
};

inline Hunt hunt_from_rgb(float r, float g, float b) {
    Relative xyz = relative_from_rgb(r, g, b);
    float fx = lab_curve(xyz.x), fy = lab_curve(xyz.y), fz = lab_curve(xyz.z);
    float l = 116 * fy - 16;
    return {l, 0.01f * l * (500 * (fx - fy)), 0.01f * l * (200 * (fy - fz))};
}

inline float hyab(float l, float a, float b) {
    return std::abs(l) + std::sqrt(a * a + b * b);
}

// The greatest difference of two colours on the screen: pure green and pure blue.
float greatest_difference() {
    Hunt green = hunt_from_rgb(0, 1, 0), blue = hunt_from_rgb(0, 0, 1);
    return std::pow(hyab(green.l - blue.l, green.a - blue.a, green.b - blue.b), kExponent);
}

}  // namespace

void opponent_from_srgb(const uint8_t* rgb, size_t width, const OpponentRow& out) {
    const std::array<double, 256>& linear = linear_of_srgb_codes();
    for (size_t x = 0; x < width; ++x) {
        auto light = [&](size_t channel) { return float(linear[rgb[3 * x + channel]]); };
        Relative xyz = relative_from_rgb(light(0), light(1), light(2));
        out.y[x] = xyz.y;
        out.red_green[x] = xyz.x - xyz.y;
        out.yellow_blue[x] = xyz.y - xyz.z;
    }
}

void hunt_from_opponent(const OpponentRow& in, size_t width, const HuntRow& out) {
    for (size_t i = 0; i < width; ++i) {
        float y = in.y[i], x = (y + in.red_green[i]) * kWhite[0], z = (y - in.yellow_blue[i]) * kWhite[2];
        auto screen = [&](int c) {
            float value = kRgbFromXyz[c][0] * x + kRgbFromXyz[c][1] * y + kRgbFromXyz[c][2] * z;
            value = value < 0 ? 0 : value;
            return value > 1 ? 1 : value;
        };
        Hunt hunt = hunt_from_rgb(screen(0), screen(1), screen(2));
        out.l[i] = hunt.l;
        out.a[i] = hunt.a;
        out.b[i] = hunt.b;
    }
}

void colour_difference(const HuntRow& a, const HuntRow& b, size_t width, float* out) {
    static const float kGreatest = greatest_difference();
    const float knee = kKneeOfGreatest * kGreatest;
    for (size_t i = 0; i < width; ++i) out[i] = hyab(a.l[i] - b.l[i], a.a[i] - b.a[i], a.b[i] - b.b[i]);
    for (size_t i = 0; i < width; ++i) {
        float difference = std::pow(out[i], kExponent);
        float above = kKneeTo + (difference - knee) / (kGreatest - knee) * (1 - kKneeTo);
        out[i] = difference < knee ? kKneeTo / knee * difference : std::min(above, 1.0f);
    }
}

}  // namespace overlook::view
