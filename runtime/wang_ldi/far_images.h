// Directional textures made ready to be drawn: of each texel, a box that lets some light through, those points that are drawn in
// its place. As many of them as its opacity says are there, so that what is drawn over each other, opaque, shows as much of each
// texel as the boxes would, whatever the order.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 8 (directional textures); E.
// Enderton, E. Sintorn, P. Shirley, D. Luebke, Stochastic Transparency, 2010. Different: which points are drawn is decided once,
// at places on the ground, so that nothing flickers; evenly spread (M. Roberts, The Unreasonable Effectiveness of Quasirandom
// Sequences, 2018), so that they leave few gaps.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "formats/wang_textures.h"

namespace overlook::wang_ldi {

// The image with this number (index_of), or null where it is not at hand. Any thread.
using ImageAt = std::function<const Ldi*(uint64_t index)>;

// So many rows of tiles at most are drawn by the points of one.
constexpr double kMostRows = 4;

// A point of a far tile, drawn where more than `needs` of its picture is asked for; 1 is what the texture's opacity says.
struct FarSample {
    float x_m = 0, y_m = 0;  // of the tile
    float height_m = 0;      // above the ground
    float needs = 0;
    uint32_t colour = 0;  // as of Warped
    uint8_t column = 0, row = 0;
};

// Of a tile, from a direction, at one fineness.
struct FarPicture {
    uint32_t side_px = 0;
    float wide_m = 0;                // of a point: a texel's width as it looks from the direction
    float high_m = 0;                // of a texel's box, the mean of those that show something
    std::vector<uint32_t> first;     // [side_px^2 + 1] texel (column, row) has samples first[row * side_px + column] on
    std::vector<FarSample> samples;  // from the lowest up in a texel
    std::vector<FarSample> by_need;  // the same, those that need least first
};

// All that is seen of a tile from a direction, as one box.
struct FarMean {
    uint32_t colour = 0;  // as of Warped; 0: nothing is seen
    float middle_m = 0, half_m = 0, opacity = 0;
};

class FarImages {
  public:
    FarImages() = default;  // nothing is anywhere
    // Whether they fit: at most kMostPoints, and 64 a texel. Else Exit::impossible, which names the file: "meadow.ovl:
    // directional textures that may need 17,000,000,000 points; 67,108,864 at most". O(texels).
    static Result<void> check(const TextureSet& textures, const std::string& file);
    static constexpr uint64_t kMostPoints = 1u << 26;
    // Of textures that fit. O(points).
    explicit FarImages(const TextureSet& textures);

    bool is_empty() const { return pictures_.empty(); }
    uint32_t side_px() const { return side_px_; }  // of the finest pictures
    // level: below texture_levels(side_px()).
    const FarPicture& picture(uint32_t context, uint32_t tile, uint32_t direction, uint32_t level) const {
        return pictures_[index_of(context, tile, direction) * levels_ + level];
    }
    const FarMean& mean(uint32_t context, uint32_t tile, uint32_t direction) const {
        return means_[index_of(context, tile, direction)];
    }
    // Of a tile at a level: no point of any of its pictures needs less.
    float least_need(uint32_t tile, uint32_t level) const { return least_needs_[size_t(tile) * levels_ + level]; }
    // Of all pictures of a level that have points: no box is less high.
    float least_high_m(uint32_t level) const { return least_high_m_[level]; }
    // How wide a square of ground looks from a direction, of its side: so wide are a texel's points.
    double breadth(uint32_t direction) const { return double(breadths_[direction]); }
    float most_half_m() const { return most_half_m_; }  // of all means
    uint64_t bytes() const;

  private:
    void take(const FarPicture& picture, uint32_t tile, uint32_t level);
    size_t index_of(uint32_t context, uint32_t tile, uint32_t direction) const {
        return (size_t(context) * tiles_ + tile) * directions_ + direction;
    }
    uint32_t side_px_ = 0, levels_ = 0, tiles_ = 0, directions_ = 0;
    std::vector<FarPicture> pictures_;  // [contexts, tiles, directions, levels]
    std::vector<FarMean> means_;        // [contexts, tiles, directions]
    std::vector<float> least_needs_;    // [tiles, levels]
    std::vector<float> least_high_m_;   // [levels]
    float most_half_m_ = 0;
    std::vector<float> breadths_;  // [directions]
};

// How evenly spread numbers 0 <= it < 1 are for places of a lattice: any few beside each other are far apart.
inline float spread_at(int64_t column, int64_t row) {
    // The inverse of the plastic number and its square, as parts of 2^64.
    uint64_t sum = uint64_t(column) * 0xc13fa9a902a6328fu + uint64_t(row) * 0x91e10da5c79e7b1du;
    return float(sum >> 40) * 0x1p-24f;
}

// Texels along the side of textures_of_images' pictures.
uint32_t texture_side_of_images_px(const ImageSet& set);
// Textures made of the coarsest images, for files that have none: as fine as those images are, and as opaque as their samples.
// Of images that are not at hand nothing is seen. O(samples of the coarsest level).
TextureSet textures_of_images(const ImageSet& set, const ImageAt& image_at);

}  // namespace overlook::wang_ldi
