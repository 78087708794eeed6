// How tiles look from so far away that no image of theirs is drawn any more: a colour and a height of each tile from each
// direction.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 8 (directional textures).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "formats/wang_ldi.h"

namespace overlook::wang_ldi {

// The image with this number (index_of), or null where it is not at hand. Any thread.
using ImageAt = std::function<const Ldi*(uint64_t index)>;

// A place of a tile seen from afar.
struct FarTexel {
    uint32_t colour = 0;  // as of Warped; 0: nothing is there
    float height_m = 0;   // above the ground
};

class FarColours {
  public:
    FarColours() = default;  // nothing is anywhere
    // The mean of the samples of a tile's coarsest image from each direction, in linear light, at the mean height of those of all
    // tiles, so that no gap opens between two. Nothing where an image is missing or empty. O(samples of the coarsest level).
    static FarColours of(const ImageSet& set, const ImageAt& image_at);

    bool is_empty() const { return texels_.empty(); }
    FarTexel at(uint32_t tile, uint32_t direction) const { return texels_[size_t(tile) * direction_count_ + direction]; }

  private:
    uint32_t direction_count_ = 0;
    std::vector<FarTexel> texels_;  // [tiles, directions]
};

}  // namespace overlook::wang_ldi
