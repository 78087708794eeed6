// A field of planted tiles and what is drawn of it for a camera: a list from back to front, of single tiles near the eye and of
// ever larger blocks of tiles towards the horizon, each with the means by which it is drawn and what share of its places each of
// them shows.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, sections 4, 5.2, 5.4 and 8. Ours: order,
// culling and levels from a tree of blocks that is nowhere kept, so that the list grows with the logarithm of the distance to the
// horizon; levels and directions that fade; tiles cut in pieces where one shear would stand off the ground.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "formats/wang_ldi.h"
#include "runtime/view/camera.h"
#include "runtime/wang_ldi/fade.h"
#include "runtime/wang_ldi/horizon.h"
#include "runtime/wang_ldi/placement.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {

// All must outlive the field.
struct FieldParts {
    const ImageSet* images = nullptr;
    std::span<const uint32_t> sample_counts;  // [images->ldi_count()], by index_of
    const TileSet* set = nullptr;
    const PlaneTiling* tiling = nullptr;   // of set
    const Placement* placement = nullptr;  // of tiles of images->tile_m
    // Where tiles are drawn as geometry: so far that reaches over its tile's edges, and so high above the ground, at most.
    double overhang_m = 0, plants_high_m = 0;
};

constexpr double kDiagonal = 1.4142135623730951;  // of a square: so wide it looks at most from aside

struct FieldOptions {
    LadderOptions ladder;
    double direction_fade_share = 0.1;  // as directions_at
    // A tile is cut in 2^n x 2^n pieces, each sheared by itself, until none stands farther from the ground on the picture.
    double displacement_px = 1;
    uint32_t most_pieces_log2 = 2;  // 0..4
    // Tiles are drawn by finer images, or by geometry, where otherwise samples and what their tile stands off its ground were
    // displaced by more in the picture (planting_error_px); > 0. Such tiles are drawn by the finest where nothing else is there.
    double error_px = std::numeric_limits<double>::infinity();
    bool chooses_diagonals = true;  // false: all rise to the north-east
    uint32_t texture_side_px = 32;  // of a tile's textures, a power of two
    double block_share = 0.25;      // side of a block of tiles at most, of its distance; 0..0.5
    // No place of the ground is drawn farther from where it is: what it hides then is left out. Infinite: it hides nothing.
    double ground_error_px = std::numeric_limits<double>::infinity();
    bool widens_splats = true;  // by as much as samples stand farther apart on a slope
};
// As the paper draws: tiles up to 40 tiles away by images alone, without fades, each sheared in two.
FieldOptions paper_options(const ImageSet& set);
// Everything up to the horizon: images as far as they were sampled for, and until a tile is no more than texture_side_px wide on
// the picture; then textures until it is a pixel; then colours. tiles nearer than geometry_to_m as geometry. texture_side_px: a
// power of two.
FieldOptions options_to_horizon(const ImageSet& set, double focal_px, double geometry_to_m = 0, uint32_t texture_side_px = 32);

// One of the means of an item. At a pixel of an image it is shown if by_rung contains its rung_threshold and by_direction its
// direction_threshold. The shown of an item are whole together, less what is bare; of geometry beside images one of the two is
// whole by itself.
struct Shown {
    uint32_t rung = 0;       // of Field::ladder
    uint32_t direction = 0;  // of images, textures and colours
    Thresholds by_rung, by_direction;

    bool operator==(const Shown&) const = default;
};

// A triangle of a tile: of the piece in this column and row of 2^pieces_log2, the half of the diagonal. Everything of the tile
// above it is sheared onto the plane, which is given from the tile's own south-west corner on.
struct Half {
    uint8_t column = 0, row = 0, half = 0;
    Diagonal diagonal = Diagonal::rising;
    Plane plane;
};

struct Item {
    int64_t i = 0, j = 0;  // south-west tile
    // 0: one tile; a block covers 2^n x 2^n, of which each place is asked as it is drawn (Field::chosen), and has no shown.
    uint8_t tiles_log2 = 0;
    uint8_t tile = 0;     // of the set; of a block 0: ask the tiling at each place
    uint8_t context = 0;  // of images
    uint8_t pieces_log2 = 0;
    bool is_planted_throughout = true;  // of a block; else ask the placement at each place
    bool is_outside_cell = false;       // some image would be, were all at hand, drawn for an eye that it was not sampled for
    uint32_t first_shown = 0, shown_count = 0;
    uint32_t first_half = 0, half_count = 0;  // back to front; none unless images or geometry are shown
    uint32_t coarser_px = 0;                  // side of the coarsest image or texture of a tile, for rung_threshold; of a block 0
    uint32_t texels_px = 0;                   // side of the whole item in its finest texels, if textures or colours are shown
    uint32_t last_rung = 0;                   // of a block, the coarsest that any place of it may be shown by
    double distance_m = 0;                    // of a tile's or block's middle
    double low_m = 0, high_m = 0;             // everything of it lies between
    double displacement_m = 0;                // as Sheared, of the worst piece
};

struct FieldCounts {
    uint64_t blocks_tested = 0, tiles_tested = 0;
    uint64_t blocks_listed = 0, tiles_listed = 0;
    std::array<uint64_t, kVerdicts> tiles_by_verdict{};  // of those in sight
    uint64_t hidden = 0;                                 // tiles and blocks of them, behind the ground
    uint64_t bare_tiles = 0;                             // planted, but with bare corners only
    uint64_t cut_tiles = 0, pieces = 0;                  // in how many pieces together
    uint64_t displaced_tiles = 0;                        // farther off the ground than asked, with the most pieces too
    uint64_t outside_cell = 0;
    uint64_t samples = 0;        // of all images listed
    double samples_shown = 0;    // of those, by their shares
    uint64_t texels = 0;         // of textures and colours
    double displacement_px = 0;  // no tile's sheared ground stands farther off the real one; infinite if it may be at the eye

    uint64_t cost() const { return samples + texels; }
    void add(const FieldCounts& other);
    bool operator==(const FieldCounts&) const = default;
};

struct FieldList {
    std::vector<Item> items;  // back to front: none hides one after it, whatever the ground's heights
    std::vector<Shown> shown;
    std::vector<Half> halves;
    FieldCounts counts;
    std::shared_ptr<const Horizon> horizon;  // of the camera listed for; null: nothing is hidden

    std::span<const Shown> shown_of(const Item& item) const { return {shown.data() + item.first_shown, item.shown_count}; }
    std::span<const Half> halves_of(const Item& item) const { return {halves.data() + item.first_half, item.half_count}; }
    void clear() { items.clear(), shown.clear(), halves.clear(), counts = {}, horizon.reset(); }
    void append(const FieldList& other);  // of the same field and camera, of what is nearer
};

// A tile in sight, or a block of tiles that is to be listed as one.
struct Found {
    int64_t i = 0, j = 0;
    uint8_t log2 = 0;
    Placement::Coverage coverage = Placement::Coverage::all;
    double near_m = 0;  // of a block, as Field::distance_m of its nearest place
};
// What listing by several threads needs, kept from list to list.
struct FieldScratch {
    std::vector<Found> found;
    std::vector<FieldList> parts;
};

// By what a place is shown.
struct Chosen {
    double distance_m = 0;  // that rungs are chosen by
    Mix rungs, directions;
};

class Field {
  public:
    // Exit::bad_command if parts do not belong together or options are out of range: "a field of tiles of 2 m with images of 3
    // m".
    static Result<Field> of(const FieldParts& parts, const FieldOptions& options);

    // Replaces what is in the list, whose memory is kept. Same field, same camera, same list. Any thread.
    // O(tiles to where textures begin + log(distance to the horizon)).
    void list(const view::Camera& camera, FieldList& list) const;
    // The same by as many threads as there are.
    void list(const view::Camera& camera, FieldList& list, FieldScratch& scratch) const;

    const FieldParts& parts() const { return parts_; }
    const FieldOptions& options() const { return options_; }
    const Ladder& ladder() const { return ladder_; }
    // Which image: of a tile's item whose shown has an ldi rung. For ImageReader::read.
    uint64_t image_of(const Item& item, const Shown& shown) const;
    // Of a tile, or of a square of tiles, by its middle.
    Chosen chosen(const glm::dvec2& eye_from_middle_m, double eye_above_ground_m) const;
    // Texels of a rung of textures or colours along the side of a tile; less than 1 where one covers several.
    double texels_of(const Rung& rung) const;
    // The picture of a texture that shows a single tile by such a rung.
    uint32_t texture_level(const Rung& rung) const {
        return rung.stage == Stage::texture ? rung.level : options_.ladder.texture_levels - 1;
    }
    // The number of a tile's own that decides its fades.
    static uint64_t fade_number(int64_t i, int64_t j) { return hash_of(0, 0x6661, i, j); }
    // The farthest that a place may be taken for so that all images shown have samples within error_m of their surfaces on a tile
    // of so steep a slope, as sample_error_m; infinite if all have, the coarsest by as much as it fades. Without such: 0.
    double farthest_within_m(double error_m, double slope = 0) const;
    // By how far rungs are chosen: on the ground, and up as far as the eye is above where images are sampled from.
    double distance_m(const glm::dvec2& ground_m, double eye_above_ground_m) const;

    // Whether the ground hides all of a list's splats so wide, in metres, on such ground. Splats of tiles stand on its images'
    // heights and a step above at most.
    bool is_hidden(const FieldList& list, const Rect& rect, double ground_high_m, double wide_m) const {
        return list.horizon && list.horizon->hides(rect, ground_high_m + highest_m_, wide_m, options_.ground_error_px);
    }

  private:
    Field() = default;
    void begin(const view::Camera& camera, FieldList& list) const;
    FieldParts parts_;
    FieldOptions options_;
    Ladder ladder_;
    bool has_geometry_ = false;
    double highest_m_ = 0;      // anything that is drawn stands above its ground
    double overhang_m_ = 0;     // or reaches over its tile's edges
    double images_to_m_ = 0;    // nothing but images and geometry is shown up to here
    double blocks_from_m_ = 0;  // nothing but textures and colours is shown from here on
    double reach_m_ = 0;        // nothing is
    friend class FieldWalk;
    friend class FieldLister;
};

}  // namespace overlook::wang_ldi
