// A terrain for LOD-sprite to sit on, drawn.
#pragma once

#include <memory>

#include "runtime/lod_sprite/draw_geometry.h"
#include "runtime/lod_sprite/on_terrain.h"
#include "runtime/terrain/draw.h"

namespace overlook::lod_sprite {

class DrawnTerrain : public DrawnGeometry {
  public:
    // Both must outlive it.
    DrawnTerrain(const terrain::Refiner& refiner, terrain::Drawing& ground, const terrain::DrawOptions& look)
        : geometry_(refiner), ground_(ground), look_(look), whole_(ground, look), near_(ground, look), far_(ground, look) {}

    TerrainGeometry& geometry() override { return geometry_; }
    uint64_t take_slice() override {
        ground_.take(geometry_.slice());
        return ground_.uploaded_bytes();
    }
    uint64_t take_coarse(uint64_t near_triangle_count) override {
        ground_.take(geometry_.coarse());
        near_.take_range({0, near_triangle_count});
        far_.take_range({near_triangle_count});
        return ground_.uploaded_bytes();
    }
    gl::Surface& slice() override { return whole_; }
    gl::Surface& near() override { return near_; }
    gl::Surface& far() override { return far_; }
    Result<std::unique_ptr<DrawnGeometry>> sharing() const override;

  private:
    DrawnTerrain(const terrain::Refiner& refiner, std::unique_ptr<terrain::Drawing> own, const terrain::DrawOptions& look)
        : DrawnTerrain(refiner, *own, look) {
        own_ = std::move(own);
    }

    std::unique_ptr<terrain::Drawing> own_;  // of one that shares another's
    TerrainGeometry geometry_;
    terrain::Drawing& ground_;
    terrain::DrawOptions look_;
    terrain::CutSurface whole_, near_, far_;
};

}  // namespace overlook::lod_sprite
