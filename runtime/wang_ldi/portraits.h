// Pictures of single tiles by their images, drawn with the exact warper.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, figures 8, 9, 11 and 12.
#pragma once

#include <cstdint>

#include "formats/image.h"
#include "formats/result.h"
#include "formats/wang_ground.h"
#include "formats/wang_ldi.h"

namespace overlook::wang_ldi {

struct PortraitOptions {
    uint32_t width_px = 220;   // of each small picture; 16 or more
    uint32_t most_tiles = 24;  // of the first so many of the set; 1 or more
    uint64_t seed = 1;         // of the tiling that a tile's neighbours are taken from
};

// All fail as ImageReader::read does, and with Exit::bad_input where images and ground do not belong together: "images of 9 tiles
// of 2 m, planted are 8 of 3 m". Same file, same pictures. Of whole tiles images sampled alone are taken where the file has them.

// Each tile straight from above among its neighbours, a line round it: everything that eyes of the cell see of it, of all
// directions, as far up as there is anything (figures 11 and 12, above). Lit as the images are: without light or shadow where the
// set has normals.
Result<ImageRgb8> tiles_from_above(const ImageReader& images, const PlantedTiles& ground, const PortraitOptions& options);

// Each tile from the south-west, 30 degrees above the horizon, with its own objects alone: they are whole where they stand over
// its edges, and nothing of its neighbours' is there (figures 11 and 12, below).
Result<ImageRgb8> tiles_from_aside(const ImageReader& images, const PlantedTiles& ground, const PortraitOptions& options);

// A tile's finest images for eyes in the south, west, north and east, a column each, from half-way through their distances (1.4
// sides of the tile at least): above from where they are for, below from a quarter turn on, where the picture above in the next
// column is from (figure 8). tile < images' tile_count.
Result<ImageRgb8> directions_portrait(const ImageReader& images, uint32_t tile, const PortraitOptions& options);

// A tile by the coarsest level that has an eighth of the finest's pixels along a side at least: from where it begins, and from as
// near as above; by the finest from there (figure 9).
Result<ImageRgb8> levels_portrait(const ImageReader& images, uint32_t tile, const PortraitOptions& options);

}  // namespace overlook::wang_ldi
