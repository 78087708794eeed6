// Baked terrain: a raster of heights as a quadtree of blocks with, for every place where a triangle can be split, a proven
// bound on the error of not splitting it. The document of the sections is formats/spec/terrain.md.
//
// The hierarchy is the bintree of right isosceles triangles over a *virtual grid* of root squares, each 2^n cells
// wide (Lindstrom et al. 1996; Evans, Kirkpatrick and Townsend 2001). Virtual vertex (x, y) stands on raster sample
// (min(x, width-1), min(y, height-1)): squares that reach over the raster's edge are squeezed onto it, so that any raster
// size has few roots and no ragged rim. Every virtual vertex that is not a corner of a root square is the midpoint of the
// long side ("split vertex") of exactly one diamond: the one or two triangles that share that side.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "formats/container.h"
#include "formats/image.h"
#include "formats/result.h"

namespace overlook::terrain {

constexpr container::Tag kKind = container::tag("TERR");
constexpr int32_t kVoid = std::numeric_limits<int32_t>::min();  // a height that is not there
constexpr uint8_t kMustSplit = 255;  // error code of a diamond that covers a void: never drawn unsplit
constexpr uint32_t kBlockLog2Max = 7;  // a block spans 128 cells of its level, 129 x 129 vertices with its borders

// Where a raster lies: a flat metric frame, x = column * metres_per_column (to the right of the raster), y = -row *
// metres_per_row (up the raster), z = height in metres; its origin is the raster's first sample.
struct Frame {
    double metres_per_column = 1;
    double metres_per_row = 1;
    bool is_georeferenced = false;
    // Below only if georeferenced: of the raster's middle.
    double centre_latitude_deg = 0;
    double centre_longitude_deg = 0;
    double convergence_deg = 0;     // clockwise turn from true north to the raster's up
    double scale_distortion = 0;    // greatest relative error of the two metre figures anywhere in the raster
    std::string crs;                // "EPSG:4326", or empty
};

// The shape of the hierarchy, which follows from the raster's size alone.
struct Shape {
    uint32_t width = 0, height = 0;           // samples, >= 2 each
    uint32_t root_log2 = 0;                   // a root square spans 2^root_log2 cells: the least power of two that covers the shorter side
    uint32_t root_columns = 0, root_rows = 0; // root squares, enough to cover the raster
    uint32_t block_log2 = 0;                  // min(kBlockLog2Max, root_log2)
    uint32_t level_count = 0;                 // root_log2 - block_log2 + 1; level L has a vertex every 2^L cells

    uint32_t cells_x() const { return root_columns << root_log2; }  // virtual cells
    uint32_t cells_y() const { return root_rows << root_log2; }
};
Shape shape_of(uint32_t width, uint32_t height);

// The vertices of one level: every 2^level cells, padded to whole blocks (which may reach less far than the roots).
struct LevelGrid {
    uint32_t blocks_x = 0, blocks_y = 0;  // blocks that hold at least one sample
    uint32_t columns = 0, rows = 0;       // (blocks << block_log2) + 1
};
LevelGrid level_grid(const Shape& shape, uint32_t level);

// A terrain in memory.
struct Terrain {
    Shape shape;
    Frame frame;
    double height_step_m = 1;     // height_m = height_offset_m + height_step_m * heights[i]
    double height_offset_m = 0;
    double finest_error_m = 0;    // greatest distance of a stored height from its source sample
    std::vector<int32_t> heights; // [height, width] row-major, north first; kVoid = no data

    // Error in metres of code c: of a diamond left unsplit, against every source sample it covers, and of all its
    // descendants. codes[0] = finest_error_m; increasing; [kMustSplit] = infinity.
    std::array<float, 256> error_m{};
    // codes[level][(y >> level) * columns + (x >> level)], for virtual vertex (x, y) with x and y multiples of 2^level, not
    // both of 2^(level+1) unless level is the last. Other entries are 0 and mean nothing.
    std::vector<std::vector<uint8_t>> codes;

    ImageRgb8 texture;            // over the whole raster; may be empty

    bool is_void(uint32_t column, uint32_t row) const { return heights[size_t(row) * shape.width + column] == kVoid; }
    double height_m(uint32_t column, uint32_t row) const {
        return height_offset_m + height_step_m * heights[size_t(row) * shape.width + column];
    }
};

}  // namespace overlook::terrain
