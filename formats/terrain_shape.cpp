#include <algorithm>
#include <bit>

#include "formats/terrain.h"

namespace overlook::terrain {
namespace {

uint32_t ceil_shift(uint32_t cells, uint32_t log2) {
    return uint32_t((uint64_t(cells) + (uint64_t(1) << log2) - 1) >> log2);
}

}  // namespace

Shape shape_of(uint32_t width, uint32_t height) {
    Shape shape;
    shape.width = width;
    shape.height = height;
    uint32_t shorter = std::min(width, height) - 1;
    shape.root_log2 = uint32_t(std::bit_width(shorter - 1));
    shape.root_columns = ceil_shift(width - 1, shape.root_log2);
    shape.root_rows = ceil_shift(height - 1, shape.root_log2);
    return shape;
}

LevelGrid level_grid(const Shape& shape, uint32_t level) {
    return {2 * ceil_shift(shape.width - 1, level + 1) + 1, 2 * ceil_shift(shape.height - 1, level + 1) + 1};
}

}  // namespace overlook::terrain
