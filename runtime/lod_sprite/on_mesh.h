// A mesh for LOD-sprite to sit on.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/caveclod/near_plane.h"
#include "runtime/caveclod/refine.h"
#include "runtime/lod_sprite/geometry.h"

namespace overlook::lod_sprite {

// Two refinements of it, one for novel frames and one for keys. Each goes on from the cut before, but what it comes to depends on
// the camera alone.
class MeshGeometry : public Geometry {
  public:
    explicit MeshGeometry(const caveclod::Mesh& mesh);  // must outlive it

    view::Camera with_near_plane(const view::Camera& camera) const override {
        return caveclod::with_far_near_plane(mesh_, camera);
    }
    CutCount cut_coarse(const view::Camera& camera, const view::PixelDetail& detail) override;
    uint64_t put_near_first(const view::Camera& camera, double near_depth_m) override;
    void begin_key(const view::Camera& camera, double error_px) override;
    // A split or collapse counts as a triangle: what the faces of the key before can be used for need not be done.
    Slice next_slice(uint64_t triangles_wanted) override;
    double most_slack_m() const override { return most_slack_m_; }
    bool is_error_vertical() const override { return false; }

    // Of the coarse cut, as put_near_first left it: three vertices a face, [surfaces of the mesh].
    using BySurface = std::vector<std::vector<uint32_t>>;
    const BySurface& near() const { return near_; }
    const BySurface& far() const { return far_; }
    // The key's faces, and which of them, surface by surface, are the slice's.
    caveclod::Refinement& key() { return key_; }
    uint64_t slice_begin() const { return slice_begin_; }
    uint64_t slice_count() const { return drawn_ - slice_begin_; }

  private:
    const caveclod::Mesh& mesh_;
    double most_slack_m_ = 0;
    caveclod::Refinement coarse_, key_;
    BySurface near_, far_;
    view::Camera key_camera_;
    double key_error_px_ = 1;
    bool is_cut_ = false;                   // the key
    uint64_t slice_begin_ = 0, drawn_ = 0;  // triangles of it
};

}  // namespace overlook::lod_sprite
