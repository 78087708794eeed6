#include "runtime/lod_sprite/draw_on_terrain.h"

namespace overlook::lod_sprite {

Result<std::unique_ptr<DrawnGeometry>> DrawnTerrain::sharing() const {
    Result<terrain::Drawing> own = terrain::Drawing::sharing(ground_);
    if (!own) return tl::unexpected(own.error());
    auto drawing = std::make_unique<terrain::Drawing>(std::move(*own));
    return std::unique_ptr<DrawnGeometry>(new DrawnTerrain(geometry_.refiner(), std::move(drawing), look_));
}

}  // namespace overlook::lod_sprite
