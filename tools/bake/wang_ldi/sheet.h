// Pictures of ground of Wang tiles, after figures 3 to 6 of J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images,
// 2002.
#pragma once

#include <string>
#include <vector>

#include "formats/image.h"
#include "formats/wang_ground.h"
#include "runtime/wang_ldi/tiling.h"

namespace overlook::wang_ldi {

struct SheetPicture {
    std::string name;  // "tiles.png"
    std::string what;  // in a few words
    ImageRgb8 picture;
};

// tiles.png: the set, colours along the edges and at corners where they have some (figure 3). tiling-32.png, tiling-256.png: a
// colour for each tile, a bright one where it is planted in part (figure 4 a, b). robinson-32.png, robinson-256.png: the
// aperiodic sixteen beside it (figure 4 c, d). spectrum.png, robinson-spectrum.png: of their tiles, logarithmic, frequency 0 in
// the middle. planting-neighbours.png: what may stand to the east of tiles with one east colour, which own it (figure 5).
// planting-tiles.png: each tile with what stands over its edges (figure 6). planting.png: 6 x 6 of them. Discs: packing radius
// light, tight radius dark; of corners black, of edges in the edge's colour, of interiors green. seed: of the tilings.
Result<std::vector<SheetPicture>> sheet_of(const PlantedTiles& ground, uint64_t seed);

}  // namespace overlook::wang_ldi
