// The geometry of the hierarchy, in virtual grid coordinates: which vertices the triangles of a diamond have.
#pragma once

#include <cstdint>

#include "formats/terrain.h"

namespace overlook::terrain {

struct GridPoint {
    uint32_t x = 0, y = 0;
};

// A right isosceles triangle: the right angle at `apex`, the long side from `left` to `right`; apex, left, right turn
// counter-clockwise seen from above with north (small y) up.
struct Triangle {
    GridPoint apex, left, right;
};

// A split vertex at level L with s = 2^L lies either in the middle of a square of side 2s (x/s and y/s odd; the long side is that
// square's diagonal) or in the middle of an edge between two such squares (one of x/s, y/s odd; the long side has length 2s along
// that axis).
enum class DiamondKind { square, horizontal_edge, vertical_edge };

inline DiamondKind diamond_kind(uint32_t x, uint32_t y, uint32_t level) {
    bool x_is_odd = (x >> level) & 1, y_is_odd = (y >> level) & 1;
    if (x_is_odd && y_is_odd) return DiamondKind::square;
    return x_is_odd ? DiamondKind::horizontal_edge : DiamondKind::vertical_edge;
}

// Does the diagonal of the square of side `2^side_log2` at square coordinates (i, j) run from its north-west to its south-east
// corner? It passes through the corner whose coordinates, in units of the side, are both odd.
inline bool is_main_diagonal(uint32_t i, uint32_t j) {
    return ((i ^ j) & 1) == 0;
}

// The triangles of the diamond split at (x, y) of `level`, one or two (an edge on the border of the virtual grid has one).
// Returns the count.
int triangles_of_diamond(const Shape& shape, uint32_t x, uint32_t y, uint32_t level, Triangle out[2]);

// The raster sample on which a virtual vertex stands.
inline GridPoint sample_of(const Shape& shape, GridPoint p) {
    return {p.x < shape.width ? p.x : shape.width - 1, p.y < shape.height ? p.y : shape.height - 1};
}

// Squeezed to nothing by the raster's edge: never drawn, and neither is anything it splits into.
inline bool is_degenerate(const Shape& shape, const Triangle& t) {
    uint32_t last_x = shape.width - 1, last_y = shape.height - 1;
    return (t.apex.x >= last_x && t.left.x >= last_x && t.right.x >= last_x) ||
           (t.apex.y >= last_y && t.left.y >= last_y && t.right.y >= last_y);
}

}  // namespace overlook::terrain
