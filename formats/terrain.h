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
constexpr uint8_t kMustSplit = 255;                             // error code of a diamond that covers a void: never drawn unsplit

// Where a raster lies: a flat metric frame, x = column * metres_per_column (to the right of the raster), y = -row *
// metres_per_row (up the raster), z = height in metres; its origin is the raster's first sample.
struct Frame {
    double metres_per_column = 1;
    double metres_per_row = 1;
    bool is_georeferenced = false;
    // Below only if georeferenced: of the raster's middle.
    double centre_latitude_deg = 0;
    double centre_longitude_deg = 0;
    double convergence_deg = 0;   // clockwise turn from true north to the raster's up
    double scale_distortion = 0;  // greatest relative error of the two metre figures anywhere in the raster
    std::string crs;              // "EPSG:4326", or empty
};

// The shape of the hierarchy, which follows from the raster's size alone. A split vertex has the level of the lowest set bit of x
// | y: at level t, with s = 2^t, its diamond's long side is 2s (or the diagonal of a square of side 2s).
struct Shape {
    uint32_t width = 0, height = 0;  // samples, >= 2 each
    uint32_t root_log2 =
        0;  // a root square spans 2^root_log2 cells, the least that covers the shorter side; also the count of levels
    uint32_t root_columns = 0, root_rows = 0;  // root squares, enough to cover the raster

    uint32_t cells_x() const { return root_columns << root_log2; }  // virtual cells
    uint32_t cells_y() const { return root_rows << root_log2; }
};
Shape shape_of(uint32_t width, uint32_t height);

// The vertices of one level: every 2^level cells, as far as any diamond of that level reaches over the raster. Vertex (x, y) has
// index (y >> level) * columns + (x >> level).
struct LevelGrid {
    uint32_t columns = 0, rows = 0;  // odd
};
LevelGrid level_grid(const Shape& shape, uint32_t level);

// A terrain in memory.
struct Terrain {
    Shape shape;
    Frame frame;
    double height_step_m = 1;  // height_m = height_offset_m + height_step_m * heights[i]
    double height_offset_m = 0;
    double finest_error_m = 0;     // greatest distance of a stored height from its source sample
    std::vector<int32_t> heights;  // [height, width] row-major, north first; kVoid = no data

    // error_m[codes[t][i]] bounds the vertical distance in metres between a diamond left unsplit and every source sample that it
    // covers, and the same of all its descendants. error_m[0] = finest_error_m; increasing; error_m[kMustSplit] = infinity.
    std::array<float, 256> error_m{};
    // One grid a level, root_log2 of them. Entries whose two grid coordinates are both even belong to a coarser level and are 0.
    std::vector<std::vector<uint8_t>> codes;

    ImageRgb8 texture;  // over the whole raster; may be empty

    bool is_void(uint32_t column, uint32_t row) const { return heights[size_t(row) * shape.width + column] == kVoid; }
    double height_m(uint32_t column, uint32_t row) const {
        return height_offset_m + height_step_m * heights[size_t(row) * shape.width + column];
    }
};

// Adds the terrain's sections to a baked file: TINF, TBLK, TDIR and, if there is a texture, TTEX. Same terrain, same bytes.
// A terrain whose parts do not fit each other, or whose reference system's name is longer than 32 printable characters, is
// Exit::our_bug: "a terrain to write has heights or codes that do not fit the raster's size".
Result<void> write(container::Writer& writer, const Terrain& terrain);

// Reads a baked terrain whole. The file may be hostile; every failure is Exit::bad_input and names file, rule and place:
// "valley.ovl: T9: block 17: its bytes do not match their checksum; was the file damaged?". Memory: O(samples), of which
// a file must hold at least one byte for 521 (32 a block in its directory) before any is taken. Exit::impossible if there is not
// so much memory.
Result<Terrain> read(const std::string& path);
Result<Terrain> read(const container::Reader& file);

// What each rule of the terrain's sections says, as container::rule_text.
std::string_view rule_text(int rule);
int rule_count();

}  // namespace overlook::terrain
