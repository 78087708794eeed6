#include "formats/terrain_extents.h"

#include <algorithm>

namespace overlook::terrain {

Extent extent_of(const Shape& shape, const Block& block, uint32_t level) {
    LevelGrid grid = level_grid(shape, level);
    uint32_t span_log2 = block_log2(shape) + block.level, side = span_log2 - level;
    bool is_last_x = block.bx + 1 == blocks_along(shape.width, span_log2),
         is_last_y = block.by + 1 == blocks_along(shape.height, span_log2);
    return {level, std::min(block.bx << side, grid.columns),
            is_last_x ? grid.columns : std::min((block.bx + 1) << side, grid.columns), std::min(block.by << side, grid.rows),
            is_last_y ? grid.rows : std::min((block.by + 1) << side, grid.rows)};
}

std::vector<Extent> extents_of(const Shape& shape, const Block& block) {
    std::vector<Extent> extents;
    if (block.is_top)
        for (uint32_t level = shape.root_log2; level-- > block.level;) extents.push_back(extent_of(shape, block, level));
    else
        extents.push_back(extent_of(shape, block, block.level));
    return extents;
}

Extent on_raster(const Shape& shape, Extent extent) {
    extent.i_end = std::min(extent.i_end, ((shape.width - 1) >> extent.level) + 1);
    extent.j_end = std::min(extent.j_end, ((shape.height - 1) >> extent.level) + 1);
    return extent;
}

uint64_t vertex_count(const Extent& extent) {
    if (extent.i_begin >= extent.i_end || extent.j_begin >= extent.j_end) return 0;
    auto evens = [](uint32_t begin, uint32_t end) { return uint64_t((end + 1) / 2) - (begin + 1) / 2; };
    return uint64_t(extent.i_end - extent.i_begin) * (extent.j_end - extent.j_begin) -
           evens(extent.i_begin, extent.i_end) * evens(extent.j_begin, extent.j_end);
}

}  // namespace overlook::terrain
