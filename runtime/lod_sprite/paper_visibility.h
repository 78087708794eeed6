// Section 3.3 of Chen, Swan and Kuo, LOD-Sprite Technique for Accelerated Terrain Rendering (1999): was a triangle of the low cut
// visible when the keyframe was taken?
//
// A triangle was if its three vertices were; a vertex was if it lay in the keyframe's view and its depth differed by less than a
// thickness from what the depth buffer holds at the closest pixel (equation 3). The paper prints no thickness.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formats/terrain.h"
#include "runtime/lod_sprite/paper_table.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/camera.h"

namespace overlook::lod_sprite::paper {

enum class DepthSpace {
    // What an ordinary depth buffer holds, far (d - near) / (d (far - near)) for depth d: 0 at the camera's near plane, 1 at
    // far_m and in the background. The paper's. A thickness of it is t d^2 / near metres deep: nothing near by, everything far
    // off,
    // where what lies before the sky also passes for the sky.
    window,
    eye,  // metres along the camera's axis; the background is infinitely far
};

struct DepthTest {
    DepthSpace space = DepthSpace::window;
    double thickness = 1e-4;  // of equation 3, > 0, in the units of the space; to be swept. 1e-4 is 100 m deep at 1 km, near 1 m
    double far_m = 100'000;   // of the ordinary depth buffer: what is beyond is hidden. Not used in eye space
};

// The paper flags triangles while it makes a keyframe, but the low cut changes from frame to frame.
enum class NewTriangles {
    // Those that were not in the low cut of the keyframe get what they would have got: their vertices are tested against the kept
    // depth buffer when they first appear. It is as if the paper's "single pass over all vertices of the low-resolution geometry"
    // had gone over all that may ever be in a low cut, so that "for novel views, the visibility of each polygon to the sprite is
    // already flagged" holds of every polygon.
    tested,
    hidden,  // they have no flag, and so no sprite: what is left of it melts away as one flies on
};

// A keyframe's depth buffer with its viewing parameters.
class KeyDepth {
  public:
    // near_over_depth: [camera.height_px, camera.width_px] top row first, near_m / depth, 0 where nothing is drawn, as
    // gl::Target::read_depth gives it. Copied; no memory in the steady state.
    void keep(const view::Camera& camera, std::span<const float> near_over_depth);

    // Equation 3 for a place in the frame that the camera is in. False outside the frame, before the near plane and, in window
    // space, beyond far_m.
    bool is_visible(const glm::dvec3& place_m, const DepthTest& test) const;

    const view::Camera& camera() const { return camera_; }

  private:
    view::Camera camera_;
    view::Axes axes_{};
    double focal_px_ = 1;
    std::vector<float> near_over_depth_;
};

// The flag of every triangle that was drawn since the keyframe. A triangle is the same in two cuts if its three samples are;
// vertices that morph count as their samples.
class TriangleFlags {
  public:
    // The terrain must outlive it.
    TriangleFlags(const terrain::Terrain& terrain, const DepthTest& test, NewTriangles fresh)
        : terrain_(terrain), test_(test), new_triangles_(fresh) {}

    // Forgets all flags and makes those of the keyframe's own low cut. Cost O(triangles).
    void start(const KeyDepth& key, const terrain::Cut& low);
    // The flag of each triangle of a later cut, [n], 1 = visible in the keyframe. Cost O(triangles); memory only when more
    // triangles were seen since a keyframe than ever before.
    void read(const KeyDepth& key, const terrain::Cut& low, std::vector<uint8_t>& is_visible);

  private:
    bool is_vertex_visible(const KeyDepth& key, uint32_t sample);
    bool is_triangle_visible(const KeyDepth& key, const Triple& triangle);

    const terrain::Terrain& terrain_;
    DepthTest test_;
    NewTriangles new_triangles_;
    TripleTable vertices_, triangles_;  // by samples
};

}  // namespace overlook::lod_sprite::paper
