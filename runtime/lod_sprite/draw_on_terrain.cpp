#include "runtime/lod_sprite/draw_on_terrain.h"

namespace overlook::lod_sprite {
namespace {

// With a drawing of its own. A base, so that it is there before what draws with it.
struct OwnGround {
    terrain::Drawing own;
};
class SharingTerrain : private OwnGround, public DrawnTerrain {
  public:
    SharingTerrain(const terrain::Refiner& refiner, terrain::Drawing drawing, const terrain::DrawOptions& look)
        : OwnGround{std::move(drawing)}, DrawnTerrain(refiner, own, look) {}
};

}  // namespace

Result<std::unique_ptr<DrawnGeometry>> DrawnTerrain::sharing() const {
    Result<terrain::Drawing> own = terrain::Drawing::sharing(ground_);
    if (!own) return tl::unexpected(own.error());
    return std::make_unique<SharingTerrain>(geometry_.refiner(), std::move(*own), look_);
}

}  // namespace overlook::lod_sprite
