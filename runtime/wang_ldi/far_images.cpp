#include "runtime/wang_ldi/far_images.h"

#include <algorithm>
#include <cmath>

#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {
namespace {

constexpr double kGolden = 0.6180339887498949;
constexpr uint32_t kMostSlices = 64;
constexpr double kMostRise = 2.5;  // of what the ground of a texel adds to its height

double breadth_of(uint32_t direction, uint32_t directions) {
    double heading = 2 * M_PI * direction / directions;
    return std::abs(std::sin(heading)) + std::abs(std::cos(heading));
}
uint32_t packed(const std::array<uint8_t, 4>& colour) {
    return uint32_t(colour[0]) | uint32_t(colour[1]) << 8 | uint32_t(colour[2]) << 16 | 0xff000000u;
}

// A texel's box within what a tile can hold.
struct FarBox {
    double low_m, high_m;

    FarBox(const TextureSet& set, const std::array<uint8_t, 2>& heights) {
        double middle = set.height_m(heights[0]), half = set.half_height_m(heights[1]);
        low_m = std::max(set.low_m, middle - half), high_m = std::min(set.high_m, middle + half);
    }
    double tall_m() const { return high_m - low_m; }
};

// Slices of a box about as high as they are wide.
uint32_t slices_of(const FarBox& box, double wide_m) {
    return uint32_t(std::clamp(std::ceil(box.tall_m() / wide_m), 1.0, double(kMostSlices)));
}

class PictureMaker {
  public:
    PictureMaker(const TextureSet& set, const DirectionalTexture& texture, uint32_t tile, uint32_t direction, uint32_t level)
        : set_(set), texture_(texture), at_(texture_level_at(set.side_px, level)) {
        picture_.side_px = set.side_px >> level;
        texel_m_ = set.tile_m / picture_.side_px;
        wide_m_ = texel_m_ * breadth_of(direction, set.direction_count);
        shift_ = double(hash_of(tile, 0x6674, level, 0) >> 40) * 0x1p-24;
    }
    FarPicture made() {
        picture_.wide_m = float(wide_m_), picture_.high_m = float(mean_height_m());
        picture_.first.push_back(0);
        for (uint32_t row = 0; row < picture_.side_px; ++row)
            for (uint32_t column = 0; column < picture_.side_px; ++column) {
                add_texel(column, row);
                picture_.first.push_back(uint32_t(picture_.samples.size()));
            }
        picture_.samples.shrink_to_fit();
        picture_.by_need = picture_.samples;
        std::stable_sort(picture_.by_need.begin(), picture_.by_need.end(),
                         [](const FarSample& a, const FarSample& b) { return a.needs < b.needs; });
        return std::move(picture_);
    }

  private:
    double mean_height_m() const {
        double sum = 0, weights = 0;
        for (size_t t = at_; t < at_ + size_t(picture_.side_px) * picture_.side_px; ++t) {
            double opacity = texture_.colours[t][3];
            sum += opacity * FarBox(set_, texture_.heights[t]).tall_m(), weights += opacity;
        }
        return weights > 0 ? sum / weights : 0;
    }
    // The box in slices, each there or not.
    void add_texel(uint32_t column, uint32_t row) {
        size_t texel = at_ + size_t(row) * picture_.side_px + column;
        double opacity = texture_.colours[texel][3] / 255.0;
        FarBox box(set_, texture_.heights[texel]);
        if (opacity == 0 || box.tall_m() <= 0) return;
        uint32_t slices = slices_of(box, wide_m_);
        double slice_m = box.tall_m() / slices, most = kMostRows * (1 + kMostRise * texel_m_ / double(picture_.high_m));
        for (uint32_t s = 0; s < slices; ++s) {
            double place = double(spread_at(column, row)) + s * kGolden + shift_;
            double needs = (place - std::floor(place)) / (opacity * std::min(1.0, slice_m / wide_m_));
            if (needs > most) continue;
            picture_.samples.push_back({float((column + 0.5) * texel_m_), float((row + 0.5) * texel_m_),
                                        float(box.low_m + (s + 0.5) * slice_m), float(needs), packed(texture_.colours[texel]),
                                        uint8_t(column), uint8_t(row)});
        }
    }

    const TextureSet& set_;
    const DirectionalTexture& texture_;
    size_t at_;
    FarPicture picture_;
    double texel_m_, wide_m_, shift_;
};

}  // namespace

Result<void> FarImages::check(const TextureSet& textures, const std::string& file) {
    uint64_t points = 0;
    for (size_t t = 0; t < textures.textures.size(); ++t) {
        const DirectionalTexture& texture = textures.textures[t];
        double breadth = breadth_of(uint32_t(t % textures.direction_count), textures.direction_count);
        for (uint32_t level = 0; level < texture_levels(textures.side_px); ++level) {
            size_t side = textures.side_px >> level, at = texture_level_at(textures.side_px, level);
            double wide_m = textures.tile_m / double(side) * breadth;
            for (size_t texel = at; texel < at + side * side; ++texel)
                if (texture.colours[texel][3] > 0) points += slices_of(FarBox(textures, texture.heights[texel]), wide_m);
        }
    }
    if (points <= kMostPoints) return {};
    return impossible("{}: directional textures that may need {} points; {} at most", file, points, kMostPoints);
}

FarImages::FarImages(const TextureSet& textures)
    : side_px_(textures.side_px),
      levels_(texture_levels(textures.side_px)),
      tiles_(textures.tile_count),
      directions_(textures.direction_count),
      least_needs_(size_t(tiles_) * levels_, std::numeric_limits<float>::infinity()),
      least_high_m_(levels_, std::numeric_limits<float>::infinity()) {
    for (uint32_t direction = 0; direction < directions_; ++direction)
        breadths_.push_back(float(breadth_of(direction, directions_)));
    for (uint32_t context = 0; context < textures.context_count; ++context)
        for (uint32_t tile = 0; tile < tiles_; ++tile)
            for (uint32_t direction = 0; direction < directions_; ++direction) {
                const DirectionalTexture& texture = textures.textures[size_t(textures.index_of(context, tile, direction))];
                for (uint32_t level = 0; level < levels_; ++level) {
                    pictures_.push_back(PictureMaker(textures, texture, tile, direction, level).made());
                    take(pictures_.back(), tile, level);
                }
                FarMean mean;
                if (FarBox box(textures, texture.heights.back()); texture.colours.back()[3] > 0 && box.tall_m() > 0) {
                    mean.colour = packed(texture.colours.back()), mean.opacity = texture.colours.back()[3] / 255.0f;
                    mean.middle_m = float((box.low_m + box.high_m) / 2), mean.half_m = float(box.tall_m() / 2);
                }
                means_.push_back(mean);
                most_half_m_ = std::max(most_half_m_, mean.half_m);
            }
}

void FarImages::take(const FarPicture& picture, uint32_t tile, uint32_t level) {
    if (picture.by_need.empty()) return;
    float& least = least_needs_[size_t(tile) * levels_ + level];
    least = std::min(least, picture.by_need.front().needs);
    least_high_m_[level] = std::min(least_high_m_[level], picture.high_m);
}

uint64_t FarImages::bytes() const {
    uint64_t bytes = pictures_.size() * sizeof(FarPicture) + means_.size() * sizeof(FarMean) +
                     (least_needs_.size() + least_high_m_.size() + breadths_.size()) * sizeof(float);
    for (const FarPicture& picture : pictures_)
        bytes += picture.first.size() * sizeof(uint32_t) + 2 * picture.samples.size() * sizeof(FarSample);
    return bytes;
}

}  // namespace overlook::wang_ldi
