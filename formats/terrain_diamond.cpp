#include "formats/terrain_diamond.h"

namespace overlook::terrain {

int triangles_of_diamond(const Shape& shape, uint32_t x, uint32_t y, uint32_t level, Triangle out[2]) {
    uint32_t s = 1u << level;
    int count = 0;
    switch (diamond_kind(x, y, level)) {
        case DiamondKind::square: {
            GridPoint nw{x - s, y - s}, ne{x + s, y - s}, sw{x - s, y + s}, se{x + s, y + s};
            if (is_main_diagonal((x - s) >> (level + 1), (y - s) >> (level + 1))) {
                out[count++] = {ne, nw, se};
                out[count++] = {sw, se, nw};
            } else {
                out[count++] = {nw, sw, ne};
                out[count++] = {se, ne, sw};
            }
            break;
        }
        case DiamondKind::horizontal_edge: {
            GridPoint west{x - s, y}, east{x + s, y};
            if (y >= s) out[count++] = {{x, y - s}, west, east};
            if (y + s <= shape.cells_y()) out[count++] = {{x, y + s}, east, west};
            break;
        }
        case DiamondKind::vertical_edge: {
            GridPoint north{x, y - s}, south{x, y + s};
            if (x >= s) out[count++] = {{x - s, y}, south, north};
            if (x + s <= shape.cells_x()) out[count++] = {{x + s, y}, north, south};
            break;
        }
    }
    return count;
}

}  // namespace overlook::terrain
