// Pictures of directional textures: as they are stored, and as far eyes see them.
#pragma once

#include <vector>

#include "formats/wang_textures.h"
#include "tools/bake/wang_ldi/sheet.h"

namespace overlook::wang_ldi {

// Rows of tiles among neighbours, 6 at most, columns of directions, 12 at most. textures-above.png: the finest picture from
// above, north up, each texel its colour over a grey by its opacity. textures-aside.png: its boxes, drawn over each other along
// the sight lines of an eye in the middle of the direction and of the heights, from where textures begin, but as large as the
// tile fills the picture; over a grey, low_m in the lowest row. None if the set has no textures.
std::vector<SheetPicture> sheet_of(const TextureSet& set);

}  // namespace overlook::wang_ldi
