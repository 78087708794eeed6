// How the heights and error codes of a terrain are cut into blocks that stream coarse to fine, and packed: see
// formats/spec/terrain.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "formats/terrain.h"

namespace overlook::terrain {

constexpr uint32_t kBlockLog2Max = 7;    // a block spans up to 128 vertices of its level each way, one more at the raster's end
constexpr int32_t kHeightMax = 1 << 28;  // |height in steps|

// Which vertices a block holds: of the grid of its level, columns [i_begin, i_end) and rows [j_begin, j_end), those that no
// coarser level has; a block of the coarsest stage (`is_top`) holds what all levels from `level` up have there.
struct Block {
    uint32_t level = 0;
    uint32_t bx = 0, by = 0;
    bool is_top = false;
};

// All blocks of a terrain in file order: coarse to fine, row by row. Their number is O(samples / 16,384 + 1).
std::vector<Block> blocks_of(const Shape& shape);
// How many that are, without making them.
uint64_t block_count_of(const Shape& shape);

struct BlockRange {
    int32_t low = 0, high = -1;  // in steps; low > high: all void
};
// Lowest and highest height that a block holds.
BlockRange range_of(const Terrain& terrain, const Block& block);

// The block's bytes before compression. All coarser blocks are read from `terrain` as prediction.
std::vector<std::byte> pack_block(const Terrain& terrain, const Block& block);

// The reverse, into `terrain`, whose coarser blocks are unpacked already; the bytes may be hostile. Returns null, or what is
// wrong.
const char* unpack_block(std::span<const std::byte> bytes, const Block& block, Terrain& terrain);

// A grid of heights to unpack into: of every 2^log2-th vertex from (x, y) on, in rows of `stride`.
struct HeightGrid {
    int32_t* heights = nullptr;
    size_t stride = 0;
    uint32_t x = 0, y = 0, log2 = 0;

    size_t index(uint32_t at_x, uint32_t at_y) const { return size_t((at_y - y) >> log2) * stride + ((at_x - x) >> log2); }
};
// Where the codes of a run go: the first, and from one to the next.
struct CodeRow {
    uint8_t* code = nullptr;
    ptrdiff_t step = 1;
};
struct Extent;
struct Run;

// The same into a part of a terrain: the grid holds the vertices of coarser blocks that this one's predictions ask for, and has
// places for its own (terrain_tiles.h).
const char* unpack_block(std::span<const std::byte> bytes, const Block& block, const Shape& shape, const HeightGrid& grid,
                         const std::function<CodeRow(const Extent&, Run)>& code_row);

// The greatest size pack_block can give.
uint64_t packed_bytes_max(const Shape& shape, const Block& block);

}  // namespace overlook::terrain
