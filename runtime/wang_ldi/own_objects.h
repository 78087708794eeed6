// Which samples of a tile's images stand on which of its objects: tight radii overlap nowhere, so that a place of a tile is of
// the object whose tight radius it lies in.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/wang_ground.h"
#include "formats/wang_ldi.h"

namespace overlook::wang_ldi {

// For the pixels of a tile's images of one level: the object that each is of.
class ObjectMap {
  public:
    // ground has the tile; side_px as the level's. O(side_px^2 * objects).
    ObjectMap(const PlantedTiles& ground, size_t tile, uint32_t side_px);

    // Only those samples of the image that stand on objects whose middles lie in the square of the tile's size from low_m on, in
    // the tile's own frame: {0, 0}: its own ones, without those that reach in; {-tile_m, 0}: those of the tile to the west, as
    // far as they reach in. An image without samples keeps no palette.
    Ldi only_of_square(const Ldi& ldi, const glm::dvec2& low_m) const;

  private:
    double tile_m_;
    std::vector<Planted> objects_;    // of the tile, then those that reach in
    std::vector<uint32_t> of_pixel_;  // [side_px^2], row 0 in the south: of objects_, which has one at least
};

}  // namespace overlook::wang_ldi
