// Directional textures of Wang tiles: for each tile and direction of view a small picture of the tile as far eyes see it, with
// heights, to be drawn beyond the farthest level of layered depth images (runtime/wang_ldi).
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 8 (eight of about 32 x 32 a tile);
// S. Laine, T. Karras, Efficient Sparse Voxel Octrees, 2010 (opacity of what is finer than a cell). Different: a texel is a box
// that stands on the tile, with a height and an opacity of its own, for those eyes see a tile nearly from the side.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "formats/container.h"
#include "formats/result.h"
#include "formats/wang_ldi.h"

namespace overlook::wang_ldi {

constexpr uint32_t kMostTextureSide_px = 256;
constexpr uint64_t kMostTextureBytes = uint64_t(1) << 28;  // of all of a file, before compression

// A picture and all coarser ones, side_px, side_px / 2 .. 1 texels a side, finest first, each row by row from the south, in a row
// from the west. Texel (column, row) of s a side is the square of tile_m / s from (column, row) of them on, and in it a box from
// height - half height to height + half height. Boxes drawn over each other back to front, each with its colour and opacity, are
// what the eyes see. A coarser texel is counted from the same rays, so its colour, height and normal are the means of all that
// is seen in its square; the last is the tile's mean by direction.
struct DirectionalTexture {
    // Red, green, blue, sRGB-encoded, of the (linear) mean of what is seen; and opacity, 0..255 for 0..1, such that boxes drawn
    // over each other show as much of each as is seen over its square (less where more than 1 were needed). A texel of which
    // nothing is seen has opacity 0, and else what the next coarser one has.
    std::vector<std::array<uint8_t, 4>> colours;
    // Height of the box's middle above low_m, and half the height of the box, as the baker chose them after what is seen; of the
    // box that is shown which is between low_m and high_m. In steps of (high_m - low_m) / 255.
    std::vector<std::array<uint8_t, 2>> heights;
    // Mean normal of what is seen, times 127; the shorter, the more normals differ. None unless the set has them.
    std::vector<std::array<int8_t, 3>> normals;
    float unseen_share = 0;    // of rays' hits, those in a texel that none hit before, as estimated when rays stopped
    float standard_error = 0;  // of a finest texel's colour, as eyes differ (root mean square over hits; luma, linear)

    bool operator==(const DirectionalTexture&) const = default;
};

struct TextureSet {
    uint32_t side_px = 32;                 // of the finest picture: a power of two
    double tile_m = 0;                     // as ImageSet, and so are counts and has_normals
    double low_m = 0, high_m = 0;          // everything in a tile lies between
    double nearest_m = 0, farthest_m = 0;  // eyes, on the ground from the tile's middle
    double eye_low_m = 0, eye_high_m = 0;  // above the tile's ground
    uint32_t tile_count = 0, direction_count = 0, context_count = 1;
    bool has_normals = false;                  // colours are unlit
    float direction_fade = 0;                  // as of the images, which state it
    std::vector<DirectionalTexture> textures;  // [context_count, tile_count, direction_count]

    uint64_t texture_count() const { return uint64_t(context_count) * tile_count * direction_count; }
    uint64_t index_of(uint32_t context, uint32_t tile, uint32_t direction) const {
        return (uint64_t(context) * tile_count + tile) * direction_count + direction;
    }
    double height_m(uint8_t code) const { return low_m + (high_m - low_m) * code / 255; }
    double half_height_m(uint8_t code) const { return (high_m - low_m) * code / 255; }

    bool operator==(const TextureSet&) const = default;
};

// How many pictures a texture has, down to one texel; how many texels all of them; where the texels of one begin.
uint32_t texture_levels(uint32_t side_px);
size_t texture_texels(uint32_t side_px);
size_t texture_level_at(uint32_t side_px, uint32_t level);

// Adds the section WLDT. Exit::our_bug if the set breaks a rule or is not of these images: "textures to write have ...".
Result<void> write_textures(container::Writer& writer, const ImageSet& images, const TextureSet& set);

bool has_textures(const container::Reader& file);
// The file may be hostile; every failure of form is Exit::bad_input and names file, rule and place: "field.ovl: X6: textures of 3
// tiles, images of 4". A file without the section breaks X1. Exit::impossible if there is not so much memory.
Result<TextureSet> read_textures(const container::Reader& file, const ImageSet& images);

// What each rule of this section says, as container::rule_text.
std::string_view texture_rule_text(int rule);
int texture_rule_count();

}  // namespace overlook::wang_ldi
