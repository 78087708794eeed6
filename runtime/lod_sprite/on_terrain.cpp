#include "runtime/lod_sprite/on_terrain.h"

#include <algorithm>

#include "runtime/terrain/near_plane.h"

namespace overlook::lod_sprite {

view::Camera TerrainGeometry::with_near_plane(const view::Camera& camera) const {
    return terrain::with_clear_near_plane(refiner_.terrain(), camera);
}

CutCount TerrainGeometry::cut_coarse(const view::Camera& camera, const view::PixelDetail& detail) {
    refiner_.cut_by_pixels(camera, detail, coarse_);
    return {coarse_.triangle_count(), coarse_.tested_count};
}

uint64_t TerrainGeometry::put_near_first(const view::Camera& camera, double near_depth_m) {
    if (near_depth_m <= 0) return 0;
    view::Axes axes = view::axes_of(camera);
    far_indices_.clear();
    size_t kept = 0;
    for (size_t i = 0; i < coarse_.indices.size(); i += 3) {
        double farthest_m = 0;
        for (size_t j = i; j < i + 3; ++j) {
            glm::dvec3 away_m = refiner_.vertex_m(coarse_, coarse_.indices[j]) - camera.position_m;
            farthest_m = std::max(farthest_m, glm::dot(away_m, axes.forward));
        }
        if (farthest_m < near_depth_m) {
            std::copy_n(&coarse_.indices[i], 3, &coarse_.indices[kept]);
            kept += 3;
        } else {
            far_indices_.insert(far_indices_.end(), &coarse_.indices[i], &coarse_.indices[i] + 3);
        }
    }
    std::copy(far_indices_.begin(), far_indices_.end(), coarse_.indices.begin() + ptrdiff_t(kept));
    return kept / 3;
}

Geometry::Slice TerrainGeometry::next_slice(uint64_t triangles_wanted) {
    key_->next(triangles_wanted, slice_);
    return {{slice_.triangle_count(), slice_.tested_count}, key_->is_done()};
}

}  // namespace overlook::lod_sprite
