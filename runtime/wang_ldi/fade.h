// By which means a place is drawn from how far and from which side, and how one gives way to the next without a pop: both are
// drawn within a band, and a hash of each place decides for one of them, so that together they are whole.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, sections 4 (rings and wedges, figure 7) and
// 8 (blending, directional textures); A. Appleby, MurmurHash3, 2011 (its last step of 32 bits, which every place is stirred by).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "formats/wang_ldi.h"
#include "runtime/wang_ldi/pixel_grid.h"
#include "runtime/wang_ldi/random.h"

namespace overlook::wang_ldi {

// From near to far. texture: a picture of the tile as it looks from one side; colour: a mean of several tiles; bare: nothing.
enum class Stage : uint8_t { geometry, ldi, texture, colour, bare };

struct Rung {
    Stage stage = Stage::ldi;
    // Of images; of textures how often their sides are halved; of colours the binary logarithm of the tiles along a texel's side,
    // 1 or more; else 0.
    uint32_t level = 0;
    double from_m = 0;  // up to the next rung's
    // Within these the rung before gives way to this one; from_m in their middle, or all three the same.
    double fade_from_m = 0, fade_to_m = 0;
};

// Rungs by ascending distance, the first from 0 on. No two bands overlap. Behind all, at no distance: the coarsest images where
// no other rung has them, which are always at hand and stand in for others (ImageStore).
struct Ladder {
    std::vector<Rung> rungs;
};

struct LadderOptions {
    double geometry_to_m = 0;  // nearer tiles are drawn as what is planted on them; 0: none
    double texture_from_m = std::numeric_limits<double>::infinity();
    // From here on a texel of the finest texture is no wider than a pixel, and of coarser ones twice, four times as far.
    double texel_from_m = std::numeric_limits<double>::infinity();
    uint32_t texture_levels = 6;                                // pictures of a texture, the last of which is one texel; 1..13
    double radius_m = std::numeric_limits<double>::infinity();  // nothing is drawn beyond
    // Of a rung's distance, to both sides; 0..0.5, 0: no fades. Less where two rungs are near each other.
    double fade_share = 0.05;
    // Levels whose samples' error in metres times this is not less than where images end, with room for a fade, are left out, but
    // for the first; 0: none.
    double samples_from = 0;
    double coarser = 1;  // > 0; levels begin so much nearer than the set has them, whose samples are so much wider in the picture
};
// The levels of the set that lie between, their distances as the set has them but for coarser; then textures, each where its
// texels are a pixel wide, and colours, so far that there is no end of them to be seen (kFarthest_m). Rungs that would have no
// room are left out.
constexpr double kFarthest_m = 2e7;
Ladder ladder_of(const ImageSet& set, const LadderOptions& options);

constexpr uint32_t kWhole = 256;  // what shares add up to

// Two neighbours and how much of the second there is: 0 .. kWhole. first == second if there is only one.
struct Mix {
    uint32_t first = 0, second = 0, second_share = 0;

    bool operator==(const Mix&) const = default;
};
// Of the ladder's rungs.
Mix rungs_at(const Ladder& ladder, double distance_m);
// Of the set's directions, for an eye at such a place from a tile's middle; fade_share: of the angle between two directions, to
// both sides, 0..0.5. Without a fade: direction_for.
Mix directions_at(const ImageSet& set, const glm::dvec2& eye_from_middle_m, double fade_share);

// Which of the kWhole hashed values show an image: [from, to).
struct Thresholds {
    uint32_t from = 0, to = kWhole;

    bool contains(uint32_t value) const { return value >= from && value < to; }
    uint32_t share() const { return to - from; }
    bool operator==(const Thresholds&) const = default;
};
inline Thresholds first_of(const Mix& mix) {
    return {0, kWhole - mix.second_share};
}
inline Thresholds second_of(const Mix& mix) {
    return {kWhole - mix.second_share, kWhole};
}

// Every bit of `value` changes about half of those that come out; a bijection.
constexpr uint32_t stirred(uint32_t value) {
    value = (value ^ (value >> 16)) * 0x85ebca6bu;
    value = (value ^ (value >> 13)) * 0xc2b2ae35u;
    return value ^ (value >> 16);
}
// What decides at the places of a row: kWhole hashed values. tile: a number of the tile's own.
enum class Decides : uint32_t { rungs = 0x7275, directions = 0x6469 };
class FadeRow {
  public:
    FadeRow(uint64_t tile, Decides decides, uint32_t row)
        : number_(stirred(stirred(stirred(uint32_t(tile >> 32) ^ uint32_t(decides)) ^ uint32_t(tile)) ^ row * kApart)) {}
    uint32_t at(uint32_t column) const { return stirred(number_ ^ column * kApart) >> 24; }

  private:
    static constexpr uint32_t kApart = 0x9e3779b1u;
    uint32_t number_;
};

// What decides at a pixel of an image, of side_px, between two rungs: of both rungs' images the coarser one's pixels decide, so
// that what one leaves out the other shows. coarser_px <= side_px: pixels along its side. tile: as of FadeRow.
inline uint32_t rung_threshold(uint64_t tile, uint32_t column, uint32_t row, uint32_t side_px, uint32_t coarser_px) {
    return FadeRow(tile, Decides::rungs, cell_of(row, side_px, coarser_px)).at(cell_of(column, side_px, coarser_px));
}
// The same between two directions of one level.
inline uint32_t direction_threshold(uint64_t tile, uint32_t column, uint32_t row) {
    return FadeRow(tile, Decides::directions, row).at(column);
}

}  // namespace overlook::wang_ldi
