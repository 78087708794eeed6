#include "runtime/lod_sprite/draw_on_mesh.h"

namespace overlook::lod_sprite {
DrawnMesh::DrawnMesh(const caveclod::Mesh& mesh, const caveclod::Drawing& drawing, const caveclod::DrawOptions& look)
    : mesh_(mesh),
      drawing_(drawing),
      look_(look),
      geometry_(mesh),
      slice_buffers_(mesh),
      near_buffers_(mesh),
      far_buffers_(mesh),
      slice_(drawing, slice_buffers_, look),
      near_(drawing, near_buffers_, look),
      far_(drawing, far_buffers_, look) {}

uint64_t DrawnMesh::take_slice() {
    slice_buffers_.take(geometry_.key());
    slice_.take_range({geometry_.slice_begin(), geometry_.slice_count()});
    return slice_buffers_.uploaded_bytes();
}

uint64_t DrawnMesh::take_coarse(uint64_t) {
    near_buffers_.take(geometry_.near());
    far_buffers_.take(geometry_.far());
    return near_buffers_.uploaded_bytes() + far_buffers_.uploaded_bytes();
}

Result<std::unique_ptr<DrawnGeometry>> DrawnMesh::sharing() const {
    Result<caveclod::Drawing> own = caveclod::Drawing::sharing(drawing_);
    if (!own) return tl::unexpected(own.error());
    auto drawing = std::make_unique<caveclod::Drawing>(std::move(*own));
    return std::unique_ptr<DrawnGeometry>(new DrawnMesh(mesh_, std::move(drawing), look_));
}

}  // namespace overlook::lod_sprite
