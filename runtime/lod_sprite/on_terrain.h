// A terrain for LOD-sprite to sit on.
#pragma once

#include <optional>
#include <vector>

#include "runtime/lod_sprite/geometry.h"
#include "runtime/terrain/refine.h"

namespace overlook::lod_sprite {

class TerrainGeometry : public Geometry {
  public:
    explicit TerrainGeometry(const terrain::Refiner& refiner) : refiner_(refiner) {}  // must outlive it

    view::Camera with_near_plane(const view::Camera& camera) const override;
    CutCount cut_coarse(const view::Camera& camera, const view::PixelDetail& detail) override;
    uint64_t put_near_first(const view::Camera& camera, double near_depth_m) override;
    void begin_key(const view::Camera& camera, double error_px) override { key_.emplace(refiner_, camera, error_px); }
    Slice next_slice(uint64_t triangles_wanted) override;
    double most_slack_m() const override { return refiner_.highest_m() - refiner_.lowest_m(); }
    bool is_error_vertical() const override { return true; }

    const terrain::Refiner& refiner() const { return refiner_; }
    // As cut last.
    const terrain::Cut& coarse() const { return coarse_; }
    const terrain::Cut& slice() const { return slice_; }

  private:
    const terrain::Refiner& refiner_;
    terrain::Cut coarse_, slice_;
    std::optional<terrain::SlicedCut> key_;
    std::vector<uint32_t> far_indices_;
};

}  // namespace overlook::lod_sprite
