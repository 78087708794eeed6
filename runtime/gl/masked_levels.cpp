#include "runtime/gl/masked_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "formats/srgb.h"

namespace overlook::gl {
namespace {

// Not yet rounded: linear colours times opacity, and opacity, each 0..1.
struct Linear {
    uint32_t width = 0, height = 0;
    std::vector<std::array<float, 4>> pixels;
    std::vector<std::array<float, 3>> plain;  // colours whatever their opacity
};

uint8_t code_of(float linear) {
    return uint8_t(std::lround(255 * srgb_from_linear(double(linear))));
}

// Of each code the least light that is stored as it.
std::array<float, 256> least_of_codes() {
    std::array<float, 256> least{};
    for (uint32_t code = 1; code < least.size(); ++code) {
        uint32_t below = 0, from = std::bit_cast<uint32_t>(1.0f);  // as bits, which ascend as floats do
        while (from - below > 1) {
            uint32_t middle = below + (from - below) / 2;
            (code_of(std::bit_cast<float>(middle)) >= code ? from : below) = middle;
        }
        least[code] = std::bit_cast<float>(from);
    }
    return least;
}

// As code_of, from a table: pictures have millions of pixels.
uint8_t encoded(float linear) {
    static const std::array<float, 256> kLeast = least_of_codes();
    return uint8_t(std::upper_bound(kLeast.begin() + 1, kLeast.end(), linear) - kLeast.begin() - 1);
}

Linear linear_of(const ImageRgba8& image) {
    Linear made{image.width, image.height, {}, {}};
    for (size_t i = 0; i < image.pixels.size(); i += 4) {
        float opacity = float(image.pixels[i + 3]) / 255;
        auto light = [&](size_t channel) { return float(linear_from_srgb_code(image.pixels[i + channel])); };
        std::array<float, 3> c{light(0), light(1), light(2)};
        made.pixels.push_back({c[0] * opacity, c[1] * opacity, c[2] * opacity, opacity});
        made.plain.push_back(c);
    }
    return made;
}

// Which pixels of the larger level a pixel of the smaller one covers, and by how much.
struct Cover {
    uint32_t first = 0;
    std::array<float, 4> weights{};
    uint32_t count = 0;
};
Cover cover_of(uint32_t at, uint32_t from, uint32_t to) {
    double low = double(at) * from / to, high = double(at + 1) * from / to;
    Cover cover;
    cover.first = uint32_t(low);
    for (uint32_t x = cover.first; x < from && double(x) < high && cover.count < 4; ++x)
        cover.weights[cover.count++] = float((std::min(high, double(x) + 1) - std::max(low, double(x))) / (high - low));
    return cover;
}

Linear halved(const Linear& from) {
    Linear made{std::max(from.width / 2, 1u), std::max(from.height / 2, 1u), {}, {}};
    for (uint32_t y = 0; y < made.height; ++y)
        for (uint32_t x = 0; x < made.width; ++x) {
            Cover right = cover_of(x, from.width, made.width), down = cover_of(y, from.height, made.height);
            std::array<float, 4> sum{};
            std::array<float, 3> plain{};
            for (uint32_t j = 0; j < down.count; ++j)
                for (uint32_t i = 0; i < right.count; ++i) {
                    size_t at = size_t(down.first + j) * from.width + right.first + i;
                    float weight = down.weights[j] * right.weights[i];
                    for (size_t c = 0; c < 4; ++c) sum[c] += weight * from.pixels[at][c];
                    for (size_t c = 0; c < 3; ++c) plain[c] += weight * from.plain[at][c];
                }
            if (sum[3] > 0)
                for (size_t c = 0; c < 3; ++c) plain[c] = sum[c] / sum[3];
            made.pixels.push_back(sum);
            made.plain.push_back(plain);
        }
    return made;
}

ImageRgba8 scaled(const Linear& level, float scale) {
    ImageRgba8 image{level.width, level.height, {}};
    for (size_t i = 0; i < level.pixels.size(); ++i) {
        for (size_t c = 0; c < 3; ++c) image.pixels.push_back(encoded(level.plain[i][c]));
        image.pixels.push_back(uint8_t(std::lround(255 * std::clamp(level.pixels[i][3] * scale, 0.0f, 1.0f))));
    }
    return image;
}

// The scale is doubled until it is too much, then halved into.
ImageRgba8 with_share(const Linear& level, float cutoff, double wanted) {
    constexpr int kHalvings = 12;
    ImageRgba8 best;
    double least = 1e300, low = 0, high = 1;
    auto share_at = [&](double scale) {
        ImageRgba8 tried = scaled(level, float(scale));
        double share = opaque_share(tried, cutoff);
        // Nothing at all is worse than too much.
        double off = share == 0 && wanted > 0 ? 2 : std::abs(share - wanted);
        if (off < least) least = off, best = std::move(tried);
        return share;
    };
    share_at(1);
    while (high < 256 && share_at(high) < wanted) high *= 2;
    for (int i = 0; i < kHalvings && least > 0; ++i) {
        double middle = (low + high) / 2;
        (share_at(middle) < wanted ? low : high) = middle;
    }
    return best;
}

}  // namespace

double opaque_share(const ImageRgba8& image, float cutoff) {
    constexpr int kSide = 4;
    uint64_t count = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) {
            uint32_t right = (x + 1) % image.width, down = (y + 1) % image.height;
            auto opacity = [&](uint32_t at_x, uint32_t at_y) {
                return int(image.pixels[4 * (size_t(at_y) * image.width + at_x) + 3]);
            };
            int a = opacity(x, y), b = opacity(right, y), c = opacity(x, down), d = opacity(right, down);
            double threshold = 255.0 * double(cutoff);
            if (std::min({a, b, c, d}) >= threshold) {
                count += kSide * kSide;
                continue;
            }
            if (std::max({a, b, c, d}) < threshold) continue;
            for (int j = 0; j < kSide; ++j)
                for (int i = 0; i < kSide; ++i) {
                    double u = (i + 0.5) / kSide, v = (j + 0.5) / kSide;
                    count += (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d) >= threshold;
                }
        }
    return double(count) / (double(kSide * kSide) * image.width * image.height);
}

std::vector<ImageRgba8> masked_levels(const ImageRgba8& image, float cutoff) {
    std::vector<ImageRgba8> levels;
    double wanted = opaque_share(image, cutoff);
    Linear level = linear_of(image);
    while (level.width > 1 || level.height > 1) {
        level = halved(level);
        levels.push_back(with_share(level, cutoff, wanted));
    }
    return levels;
}

}  // namespace overlook::gl
