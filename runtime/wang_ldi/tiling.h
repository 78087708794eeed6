// Which tile of a set stands where: ground covered row by row, as the paper does it, or tile by tile in any order without
// keeping any (random access). Every edge and every corner agrees with its neighbours.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2002, section 2; L.-Y. Wei, Tile-Based Texture
// Mapping on Graphics Hardware, 2004 (edges from a hash of their place); A. Lagae, P. Dutre, An Alternative for Wang Tiles:
// Colored Edges versus Colored Corners, 2006 (corners from a hash).
// Ours: equal neighbours are avoided without dead ends; sets that lack some of the combinations of colours are accessed at
// random too, in blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "formats/result.h"
#include "formats/wang_tiles.h"
#include "runtime/wang_ldi/place_cache.h"

namespace overlook::wang_ldi {

// Tiles that stand, by index into TileSet::tiles.
struct Tiling {
    uint32_t columns = 0, rows = 0;
    std::vector<uint8_t> tiles;  // [rows, columns], row-major, south first

    uint8_t at(uint32_t x, uint32_t y) const { return tiles[size_t(y) * columns + x]; }
};

// The colour that the corner at (x, y) has to have: tile (x, y) has it at its south-west, tile (x - 1, y - 1) at its north-east.
using CornerAt = std::function<uint8_t(int64_t x, int64_t y)>;

// Corner colours so that the ground follows a map of densities: at (x, y), whose wanted density (0..1) density_at gives, one of
// the set's two nearest densities, as often as makes the mean right; among colours of one density each as likely as the others.
// Same seed, same corners.
CornerAt corners_of_density(const TileSet& set, std::function<double(int64_t x, int64_t y)> density_at, uint64_t seed);

struct TilingOptions {
    uint64_t seed = 1;
    bool avoids_equal_neighbours = true;  // no tile stands beside itself; false: as the paper
    CornerAt corner_at;                   // empty: any
};

// Row by row, from west to east and from south to north, each tile at random among those that fit to the west and to the south
// (and to the corners asked for). Where avoiding equal neighbours could leave no tile for some place, each row is chosen
// among those that can be completed, and the row below anew if there is none. columns, rows: 1 or more. O(columns * rows).
// Exit::impossible: "a row of 40 tiles that avoids equal neighbours does not exist over some row below: ...", "no tile of the
// set fits at column 3, row 7".
Result<Tiling> tile_row_by_row(const TileSet& set, uint32_t columns, uint32_t rows, const TilingOptions& options);

// Of `side` x `side` tiles, avoiding equal neighbours if the set lets that be done, else as the paper. Fails as tile_row_by_row.
Result<Tiling> tile_square(const TileSet& set, uint32_t side, uint64_t seed);

// Whether some tile has no other to its east or to its north, or some pair of tiles to the west and to the south, that meet at a
// third, leaves no tile that fits both and equals neither.
bool can_dead_end(const TileSet& set);

// Pairs of neighbours whose edges or corners disagree, and that are equal.
struct NeighbourCount {
    uint64_t disagreeing = 0, equal = 0;
};
NeighbourCount count_neighbours(const TileSet& set, const Tiling& tiling);

// Tiles of a set everywhere on the plane.
class PlaneTiling {
  public:
    virtual ~PlaneTiling() = default;
    virtual uint8_t at(int64_t x, int64_t y) const = 0;  // index into TileSet::tiles. Any thread
};

// A tiling row by row, kept whole: the rectangle of columns x rows tiles from (x, y) on, beyond which it repeats, with edges that
// need not agree there.
class RowTiling final : public PlaneTiling {
  public:
    struct Rect {
        int64_t x = 0, y = 0;
        uint32_t columns = 1, rows = 1;
    };
    // options.corner_at is asked for corners of the plane. Fails as tile_row_by_row. Memory: a byte a tile.
    static Result<RowTiling> of(const TileSet& set, const Rect& rect, const TilingOptions& options);

    uint8_t at(int64_t x, int64_t y) const override;

  private:
    RowTiling() = default;
    Rect rect_;
    Tiling tiling_;
};

// A tiling of the whole plane that need keep no tile; some that were asked about are remembered. Edges between blocks of block()
// x block() tiles are coloured by a hash of their place; what is inside follows from them. block() is 1 for a set that has a tile
// for every four colours (whose corners agree): then at() is one look-up. Else it is the smallest with which every block's border
// can be filled, which is tried out once for every border and all corners inside; sets of 12 tiles need 2, with borders of the
// planting too. A prototile with variants never stands beside itself in the same variant.
class RandomTiling final : public PlaneTiling {
  public:
    // Exit::impossible: "a set of 8 tiles permits no random access: some border of 4 x 4 tiles cannot be filled, or there are too
    // many to try".
    static Result<RandomTiling> of(const TileSet& set, uint64_t seed, CornerAt corner_at = {});

    uint8_t at(int64_t x, int64_t y) const override;
    uint32_t block() const { return block_; }

  private:
    RandomTiling() = default;
    friend struct BlockFiller;
    uint8_t found_at(int64_t x, int64_t y) const;
    uint8_t corner(int64_t x, int64_t y) const;
    uint8_t horizontal_edge(int64_t x, int64_t y) const;  // south of tile (x, y)
    uint8_t vertical_edge(int64_t x, int64_t y) const;    // west of tile (x, y)
    uint32_t prototile(int64_t x, int64_t y) const;
    uint32_t black_variant(int64_t x, int64_t y, uint32_t variants) const;

    std::shared_ptr<PlaceCache> tiles_ = std::make_shared<PlaceCache>();
    uint64_t seed_ = 1;
    uint32_t block_ = 1;
    CornerAt corner_at_;
    size_t corner_colours_ = 1;
    std::vector<EdgeColour> horizontal_, vertical_;
    std::vector<std::vector<uint8_t>> horizontal_between_, vertical_between_;  // [low * corners + high]: colours
    std::vector<Tile> prototiles_;
    std::vector<std::vector<uint8_t>> variants_;          // [prototile]: tiles
    std::vector<std::vector<uint32_t>> fits_south_west_;  // [south * verticals + west]: prototiles
    // Of each border the prototiles of each of its fills, one after the other; none unless they are few.
    std::vector<uint32_t> first_fill_;
    std::vector<uint8_t> fills_;
};

}  // namespace overlook::wang_ldi
