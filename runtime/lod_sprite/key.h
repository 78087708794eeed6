// A key: a picture of the fine surface, kept with its depths and the camera it was taken with.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "runtime/view/camera.h"

namespace overlook::lod_sprite {

// Depths of a picture in the middles of so many equal cells, metres along the camera's axis, infinity where nothing is.
// [height, width], top row first.
struct DepthGrid {
    uint32_t width = 0, height = 0;
    std::vector<float> depth_m;
};

// The camera of a key for frames like `frame`: the same place, axes and pixels per unit of tangent, a picture larger by `guard`
// (>= 1) in both directions, so that turning does not leave it at once. A whole number of pixels; at most a view of 170 degrees.
view::Camera key_camera(const view::Camera& frame, double guard);

// How one camera's rays are seen by a key: a point at depth t on the ray of direction r (r . forward = 1) is at
// eye_m + t * (key_from_world * r) in the key's axes: x right, y up, z forward, from its eye.
struct Link {
    glm::dmat3 key_from_world;
    glm::dvec3 eye_m;     // the novel camera's
    glm::dvec2 tangents;  // of the key's half angles
};
Link link_of(const view::Camera& key, const view::Camera& novel);

}  // namespace overlook::lod_sprite
