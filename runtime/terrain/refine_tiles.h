// Cuts of a terrain of which a part is in memory. What is missing is asked for, and what is there stands in.
#pragma once

#include "runtime/terrain/refine.h"
#include "runtime/terrain/tiles.h"

namespace overlook::terrain {

// As Refiner, over tiles, which must outlive it.
class TileRefiner {
  public:
    explicit TileRefiner(const Tiles& tiles) : tiles_(tiles), bounds_(tiles) {}

    // As Refiner::cut_by_pixels, between begin_frame() and end_frame() of the tiles; indices of the cut are places in their
    // slots, from slot_count() * kTileSamples on morphs. With all tiles there that it asks for, the same triangles in the same
    // order. Else a triangle whose split vertex is not available is drawn as it is, without cracks: stopped_count counts them,
    // their code is that of the diamond they come from, whose error is no less than theirs, and predicted_error_px, which is then
    // above error_px, bounds them too (infinite where a void is not refined yet; what has a void at a corner is left out).
    void cut_by_pixels(const view::Camera& camera, double error_px, Cut& out, double morph = 0) const;

  private:
    const Tiles& tiles_;
    TileBounds bounds_;
};

}  // namespace overlook::terrain
