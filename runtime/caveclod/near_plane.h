// Where a mesh's near plane may be.
#pragma once

#include <algorithm>

#include "runtime/caveclod/mesh.h"
#include "runtime/view/camera.h"

namespace overlook::caveclod {

// The camera with its near plane moved away, as far as half the way to the mesh's box: depths as shares of the near plane's are
// then of a size, however far the mesh is.
inline view::Camera with_far_near_plane(const Mesh& mesh, view::Camera camera) {
    glm::dvec3 nearest_m = glm::clamp(camera.position_m, mesh.lowest_m(), mesh.highest_m());
    // The depth along the axis of what is in view is at least its distance's share at the picture's corner.
    double depth_m = glm::distance(camera.position_m, nearest_m) / view::corner_secant(camera);
    camera.near_m = std::max(camera.near_m, depth_m / 2);
    return camera;
}

}  // namespace overlook::caveclod
