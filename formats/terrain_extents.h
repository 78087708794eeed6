// Which vertices of which levels a block holds, and in which order: what blocks and tiles share. See formats/spec/terrain.md.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/terrain_blocks.h"

namespace overlook::terrain {

inline uint32_t top_level(const Shape& shape) {
    return shape.root_log2 - (shape.root_log2 < kBlockLog2Max ? shape.root_log2 : kBlockLog2Max);
}
inline uint32_t block_log2(const Shape& shape) {
    return shape.root_log2 < kBlockLog2Max ? shape.root_log2 : kBlockLog2Max;
}
// How many blocks of 2^span_log2 cells stand along a side of so many samples.
inline uint32_t blocks_along(uint32_t samples, uint32_t span_log2) {
    return uint32_t((uint64_t(samples) - 1 + (uint64_t(1) << span_log2) - 1) >> span_log2);
}

// The grid of a level from which a block takes its vertices: [i_begin, i_end) x [j_begin, j_end). The last block of a row or
// column holds all that is left.
struct Extent {
    uint32_t level, i_begin, i_end, j_begin, j_end;
};

Extent extent_of(const Shape& shape, const Block& block, uint32_t level);
// Of the levels whose vertices a block holds, coarse to fine.
std::vector<Extent> extents_of(const Shape& shape, const Block& block);
// The part of an extent that stands on the raster.
Extent on_raster(const Shape& shape, Extent extent);
// How many vertices of an extent belong to its level: all but those with two even coordinates.
uint64_t vertex_count(const Extent& extent);

// Vertices (i, j), (i + 2, j), ... below i_end of one row.
struct Run {
    uint32_t j, i, i_end;
};

// Calls visit(run) for the vertices of an extent that belong to its level: first middles of squares, then of edges, row by row.
template <class Visit>
void visit_runs(const Extent& extent, const Visit& visit) {
    auto first_from = [](uint32_t begin, uint32_t parity) { return begin + ((begin ^ parity) & 1); };
    for (uint32_t j = first_from(extent.j_begin, 1); j < extent.j_end; j += 2)
        visit(Run{j, first_from(extent.i_begin, 1), extent.i_end});
    for (uint32_t j = extent.j_begin; j < extent.j_end; ++j) visit(Run{j, first_from(extent.i_begin, (j + 1) & 1), extent.i_end});
}

// The corners of root squares, which belong to no level, as far as a top block holds them.
template <class Visit>
void visit_corners(const Shape& shape, const Block& block, const Visit& visit) {
    if (!block.is_top) return;
    uint64_t side = uint64_t(1) << shape.root_log2;
    for (uint64_t y = block.by * side; y <= (block.by + 1) * side && y < shape.height; y += side)
        for (uint64_t x = block.bx * side; x <= (block.bx + 1) * side && x < shape.width; x += side) {
            bool is_next_x = x != block.bx * side && block.bx + 1 < shape.root_columns;
            bool is_next_y = y != block.by * side && block.by + 1 < shape.root_rows;
            if (!is_next_x && !is_next_y) visit(uint32_t(x), uint32_t(y));
        }
}

}  // namespace overlook::terrain
