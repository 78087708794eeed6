#include "tools/measure/numbers/masts.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

namespace overlook::measure {
namespace {

constexpr uint32_t kFine = 8, kCoarse = 4, kMostTargetSide_px = 16384;

std::vector<double> areas_px(const ImageRgb8& image, uint32_t factor) {
    uint32_t width = image.width / factor;
    std::vector<double> areas(size_t(width) * (image.height / factor), 0.0);
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) {
            const uint8_t* at = &image.pixels[3 * (size_t(y) * image.width + x)];
            if (is_mast_red(at[0], at[1], at[2])) areas[size_t(y / factor) * width + x / factor] += 1.0 / (factor * factor);
        }
    return areas;
}

// Of the pixels at most `reach` away to either side, up and down.
double area_round(const std::vector<double>& areas, uint32_t width, uint32_t height, uint32_t x, uint32_t y, uint32_t reach) {
    double sum = 0;
    for (uint32_t v = y > reach ? y - reach : 0; v <= std::min(y + reach, height - 1); ++v)
        for (uint32_t u = x > reach ? x - reach : 0; u <= std::min(x + reach, width - 1); ++u)
            sum += areas[size_t(v) * width + u];
    return sum;
}

}  // namespace

bool is_mast_red(uint8_t red, uint8_t green, uint8_t blue) {
    return red > 2 * std::max(green, blue);
}

uint32_t mast_samples_a_side(uint32_t width_px, uint32_t height_px) {
    return std::max(width_px, height_px) <= kMostTargetSide_px / kFine ? kFine : kCoarse;
}

std::string mast_samples_sentence(uint32_t width_px, uint32_t height_px) {
    uint32_t samples = mast_samples_a_side(width_px, height_px);
    std::string sentence = fmt::format("{} samples a pixel", samples * samples);
    if (samples == kFine) return sentence;
    return sentence + fmt::format(
                          ", as pictures of more than {} pixels a side are too large for {}: coarser, so that a mast three "
                          "quarters as thick may count as lost",
                          kMostTargetSide_px / kFine, kFine * kFine);
}

MastLoss mast_loss(const ImageRgb8& test, const ImageRgb8& reference, uint32_t factor) {
    assert(test.width == reference.width && test.height == reference.height);
    assert(factor >= 1 && test.width % factor == 0 && test.height % factor == 0);
    uint32_t width = test.width / factor, height = test.height / factor;
    std::vector<double> there = areas_px(test, factor), wanted = areas_px(reference, factor);
    MastLoss loss;
    loss.is_lost.assign(wanted.size(), 0);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            size_t at = size_t(y) * width + x;
            if (wanted[at] == 0) continue;
            loss.mast_px += wanted[at];
            if (6 * area_round(there, width, height, x, y, 2) >= 5 * area_round(wanted, width, height, x, y, 1)) continue;
            loss.lost_px += wanted[at];
            loss.is_lost[at] = 1;
        }
    return loss;
}

}  // namespace overlook::measure
