// Directional textures for files without any.
#include <algorithm>
#include <bit>
#include <cmath>

#include "formats/srgb.h"
#include "runtime/wang_ldi/far_images.h"

namespace overlook::wang_ldi {
namespace {

constexpr uint32_t kFinestSide_px = 32;

// What is seen over a square.
struct Sum {
    uint64_t samples = 0;
    std::array<double, 3> light{};
    double height_m = 0, height_squared = 0;

    void add(const Sum& other) {
        samples += other.samples, height_m += other.height_m, height_squared += other.height_squared;
        for (size_t c = 0; c < 3; ++c) light[c] += other.light[c];
    }
};

std::vector<Sum> sums_of(const ImageSet& set, const Ldi& ldi, uint32_t side) {
    std::vector<Sum> sums(texture_texels(side));
    double step_m = double(set.levels.back().height_step_m);
    for (uint32_t pixel = 0; pixel < ldi.side_px * ldi.side_px; ++pixel) {
        uint32_t column = pixel % ldi.side_px * side / ldi.side_px, row = pixel / ldi.side_px * side / ldi.side_px;
        Sum& sum = sums[size_t(row) * side + column];
        for (uint32_t s = ldi.first[pixel]; s < ldi.first[pixel + 1]; ++s) {
            double height_m = ldi.heights[s] * step_m;
            ++sum.samples, sum.height_m += height_m, sum.height_squared += height_m * height_m;
            for (size_t c = 0; c < 3; ++c) sum.light[c] += linear_from_srgb_code(ldi.palette[ldi.colours[s]][c]);
        }
    }
    for (uint32_t level = 1; level < texture_levels(side); ++level) {
        size_t fine = texture_level_at(side, level - 1), at = texture_level_at(side, level);
        uint32_t across = side >> (level - 1);
        for (uint32_t row = 0; row < across; ++row)
            for (uint32_t column = 0; column < across; ++column)
                sums[at + size_t(row / 2) * (across / 2) + column / 2].add(sums[fine + size_t(row) * across + column]);
    }
    return sums;
}

// pixel_m: of the image. A box is as opaque as its samples cover its face.
DirectionalTexture texture_of(const TextureSet& set, const std::vector<Sum>& sums, double pixel_m) {
    DirectionalTexture texture;
    double step_m = (set.high_m - set.low_m) / 255, texel_m = set.tile_m / set.side_px;
    for (size_t t = 0, end = 0, side = set.side_px; t < sums.size(); ++t) {
        const Sum& sum = sums[t];
        if (t == 0) end = side * side;
        if (t == end) side /= 2, end += side * side, texel_m *= 2;
        std::array<uint8_t, 4>& colour = texture.colours.emplace_back();
        std::array<uint8_t, 2>& heights = texture.heights.emplace_back();
        if (sum.samples == 0) continue;
        auto count = double(sum.samples);
        for (size_t c = 0; c < 3; ++c) colour[c] = uint8_t(std::lround(255 * srgb_from_linear(sum.light[c] / count)));
        double mean_m = sum.height_m / count, variance = std::max(0.0, sum.height_squared / count - mean_m * mean_m);
        heights[0] = uint8_t(std::clamp(std::round(mean_m / step_m), 0.0, 255.0));
        heights[1] = uint8_t(std::clamp(std::round(std::sqrt(3 * variance) / step_m), 1.0, 255.0));
        double opacity = count * pixel_m * pixel_m / (texel_m * 2 * heights[1] * step_m);
        colour[3] = uint8_t(std::clamp(std::round(255 * opacity), 1.0, 255.0));
    }
    return texture;
}

}  // namespace

uint32_t texture_side_of_images_px(const ImageSet& set) {
    return std::min(kFinestSide_px, std::bit_floor(set.levels.back().side_px));
}

TextureSet textures_of_images(const ImageSet& set, const ImageAt& image_at) {
    TextureSet textures;
    textures.side_px = texture_side_of_images_px(set);
    textures.tile_m = set.tile_m, textures.low_m = set.low_m, textures.high_m = set.high_m;
    textures.nearest_m = textures.farthest_m = set.cell.farthest_m;
    textures.eye_low_m = set.cell.eye_low_m, textures.eye_high_m = set.cell.eye_high_m;
    textures.tile_count = set.tile_count, textures.direction_count = set.direction_count;
    textures.context_count = set.context_count;
    auto coarsest = uint32_t(set.levels.size() - 1);
    for (uint32_t context = 0; context < set.context_count; ++context)
        for (uint32_t tile = 0; tile < set.tile_count; ++tile)
            for (uint32_t direction = 0; direction < set.direction_count; ++direction) {
                const Ldi* ldi = image_at(index_of(set, {context, tile, coarsest, direction}));
                std::vector<Sum> sums(texture_texels(textures.side_px));
                if (ldi != nullptr) sums = sums_of(set, *ldi, textures.side_px);
                textures.textures.push_back(texture_of(textures, sums, set.tile_m / set.levels.back().side_px));
            }
    return textures;
}

}  // namespace overlook::wang_ldi
