// A mesh for LOD-sprite to sit on, drawn.
#pragma once

#include <memory>

#include "runtime/caveclod/draw.h"
#include "runtime/lod_sprite/draw_geometry.h"
#include "runtime/lod_sprite/on_mesh.h"

namespace overlook::lod_sprite {

class DrawnMesh : public DrawnGeometry {
  public:
    // Both must outlive it.
    DrawnMesh(const caveclod::Mesh& mesh, const caveclod::Drawing& drawing, const caveclod::DrawOptions& look);

    MeshGeometry& geometry() override { return geometry_; }
    uint64_t take_slice() override;
    uint64_t take_coarse(uint64_t near_triangle_count) override;
    gl::Surface& slice() override { return slice_; }
    gl::Surface& near() override { return near_; }
    gl::Surface& far() override { return far_; }
    Result<std::unique_ptr<DrawnGeometry>> sharing() const override;

  private:
    DrawnMesh(const caveclod::Mesh& mesh, std::unique_ptr<caveclod::Drawing> own, const caveclod::DrawOptions& look)
        : DrawnMesh(mesh, *own, look) {
        own_ = std::move(own);
    }

    std::unique_ptr<caveclod::Drawing> own_;  // of one that shares another's
    const caveclod::Mesh& mesh_;
    const caveclod::Drawing& drawing_;
    caveclod::DrawOptions look_;
    MeshGeometry geometry_;
    caveclod::CameraBuffers slice_buffers_, near_buffers_, far_buffers_;
    caveclod::MeshSurface slice_, near_, far_;
};

}  // namespace overlook::lod_sprite
