#include "tools/measure/numbers/picture.h"

#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace overlook::measure {
namespace {

constexpr std::array<double, 3> kRec709 = {0.2126, 0.7152, 0.0722};

[[maybe_unused]] bool are_alike(const RgbView& a, const RgbView& b) {
    return a.width == b.width && a.height == b.height && a.rgb.size() == b.rgb.size() && !a.rgb.empty();
}

// What each value of a channel adds to luma.
std::array<std::array<float, 256>, 3> luma_parts() {
    std::array<std::array<float, 256>, 3> parts;
    for (size_t c = 0; c < 3; ++c)
        for (size_t v = 0; v < 256; ++v) parts[c][v] = float(kRec709[c] * double(v) / 255);
    return parts;
}

}  // namespace

std::vector<float> luma_of(const RgbView& picture) {
    static const std::array<std::array<float, 256>, 3> kParts = luma_parts();
    std::vector<float> luma(picture.rgb.size() / 3);
    const uint8_t* rgb = picture.rgb.data();
    for (size_t i = 0; i < luma.size(); ++i, rgb += 3) luma[i] = kParts[0][rgb[0]] + kParts[1][rgb[1]] + kParts[2][rgb[2]];
    return luma;
}

double luma_difference_mean(const RgbView& a, const RgbView& b) {
    assert(are_alike(a, b));
    std::vector<float> luma_a = luma_of(a), luma_b = luma_of(b);
    double sum = 0;
    for (size_t i = 0; i < luma_a.size(); ++i) sum += std::abs(double(luma_a[i]) - double(luma_b[i]));
    return sum / double(luma_a.size());
}

double psnr_db(const RgbView& a, const RgbView& b) {
    assert(are_alike(a, b));
    uint64_t squares = 0;
    for (size_t i = 0; i < a.rgb.size(); ++i) {
        int difference = int(a.rgb[i]) - int(b.rgb[i]);
        squares += uint64_t(difference * difference);
    }
    if (squares == 0) return std::numeric_limits<double>::infinity();
    return 10 * std::log10(255.0 * 255.0 * double(a.rgb.size()) / double(squares));
}

}  // namespace overlook::measure
