// LOD-sprite as its paper has it (Chen, Swan and Kuo, LOD-Sprite Technique for Accelerated Terrain Rendering, 1999, figure 3):
// when a frame has to be a keyframe, and which triangles of the others wear the last one. No OpenGL here; draw_paper.h draws.
//
// A frame goes so:
//     decide(camera, low)                 is it a keyframe?
//     if it is: draw the high cut, keep its picture, and keep(camera, depth, low)
//     if not:   draw the low cut with flags(low)
//
// What this does not do, because the paper does not: predict keyframes, spread their cost, look at pixels one by one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "formats/terrain.h"
#include "runtime/lod_sprite/paper_error.h"
#include "runtime/lod_sprite/paper_strips.h"
#include "runtime/lod_sprite/paper_visibility.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/camera.h"

namespace overlook::lod_sprite::paper {

// "Whenever the viewer jumps to a new viewpoint position" a sprite is taken at once. The paper does not say what a jump is; and
// since the error of a view that only turns is zero, a turned view that a sprite covers no more counts as one.
struct JumpRule {
    double least_shared_view = 0.5;  // of the frame's directions, those that lie in the keyframe's frame as well, 0 .. 1
    double farthest_move = 0.25;     // from the keyframe's viewpoint, as a share of the terrain's diagonal
};

struct Options {
    double key_error_px = 1;  // epsilon of equations 1 and 2, > 0
    ErrorOptions error;
    DepthTest depth;
    NewTriangles new_triangles = NewTriangles::tested;
    std::optional<StripOptions> strips;  // nothing: every triangle by itself
    JumpRule jump;
};

enum class KeyReason { none, first, jump, error };

struct Decision {
    KeyReason reason = KeyReason::none;
    ErrorFigures error;  // of the last keyframe in this frame; all zero where there is none or it was a jump

    bool is_key() const { return reason != KeyReason::none; }
};

struct FlagCounts {
    uint64_t sprite_count = 0;          // triangles that wear the sprite
    uint64_t lost_to_strips_count = 0;  // visible ones that do not, because of the strip that they are in
    uint64_t vertex_count = 0;          // sent: of the strips, or three a triangle
};

// The share of `now`'s directions that lie in key's frame: of 16 x 16 of them, evenly over the frame. 1 for the same camera, 0
// for one that looks elsewhere. Positions do not count.
double shared_view(const view::Camera& key, const view::Camera& now);

class Sprite {
  public:
    // The terrain must outlive it. Cameras are in the terrain's own frame.
    Sprite(const terrain::Terrain& terrain, const Options& options);

    // Whether `now` must be a keyframe: there is none yet (or one of another size), the view jumped, or equation 2 fails. Changes
    // nothing. Cost O(triangles of low).
    Decision decide(const view::Camera& now, const terrain::Cut& low);
    // A keyframe was drawn. depth: KeyDepth::keep; low: what the low cut would have been.
    void keep(const view::Camera& camera, std::span<const float> near_over_depth, const terrain::Cut& low);
    // [n] for the triangles of a frame that is no keyframe: 1 = wears the sprite. Holds until the next call. There must be a
    // keyframe.
    std::span<const uint8_t> flags(const terrain::Cut& low);
    const FlagCounts& counts() const { return counts_; }  // of the last flags()

    bool has_key() const { return has_key_; }
    const view::Camera& key_camera() const { return key_.camera(); }

  private:
    bool is_jump(const view::Camera& now) const;

    Options options_;
    double diagonal_m_;
    ErrorMetric metric_;
    TriangleFlags visible_;
    KeyDepth key_;
    Strips strips_;
    bool has_key_ = false;
    std::vector<uint8_t> flags_;
    FlagCounts counts_;
};

}  // namespace overlook::lod_sprite::paper
