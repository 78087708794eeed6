// Drawing LOD-sprite as its paper has it (paper_sprite.h): keyframes are copied, other frames wear the copy triangle by triangle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/gl/target.h"
#include "runtime/terrain/draw.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/camera.h"

namespace overlook::lod_sprite::paper {

// "Our implementation of LOD-sprite does not use projective texture mapping": places in the sprite are worked out for vertices
// and interpolated over triangles. How, the paper does not say.
enum class Coordinates {
    // With the vertex's depth from the keyframe as fourth coordinate, so that from the keyframe's own viewpoint a triangle shows
    // just what the sprite has there, as section 3.2 supposes ("from v1 this projection makes no visible difference").
    homogeneous,
    // Two coordinates: on triangles that reach from near to far the sprite bends, from the keyframe's viewpoint as well.
    plain,
};

// Draws one terrain into pictures of one size. A context must be current. The drawing must outlive it, and is drawn with here
// only while one of the functions below runs.
class Drawing {
  public:
    // Fails with Exit::impossible if the renderer cannot hold pictures of that size, Exit::our_bug if a shader is wrong.
    static Result<Drawing> make(terrain::Drawing& ground, uint32_t width_px, uint32_t height_px);

    // Draws the high cut into `target`, of this size and any number of samples, and keeps a copy of the picture, the air in it,
    // as the sprite. near_over_depth becomes what the keyframe's depth buffer holds at the pixels' middles ([height_px, width_px]
    // top row first, gl::Target::read_depth): a target of several samples a pixel has none such, and the cut is drawn a second
    // time for it. Waits until all is drawn.
    Result<void> draw_key(const gl::Target& target, const terrain::Cut& high, const view::Camera& camera,
                          const terrain::DrawOptions& options, std::vector<float>& near_over_depth);

    // Draws the low cut: triangles with is_visible != 0 wear the sprite, the others the terrain's own texture. One draw call for
    // both, with both textures bound. is_visible: [triangles], 1 only for those that lay wholly in the keyframe's frame. key: the
    // camera of the last draw_key(); without one there must be no 1 in is_visible.
    void draw_novel(const gl::Target& target, const terrain::Cut& low, std::span<const uint8_t> is_visible,
                    const view::Camera& key, const view::Camera& camera, const terrain::DrawOptions& options,
                    Coordinates coordinates = Coordinates::homogeneous);
    // The same frame as a mask in the red channel, without a sky: 1 where the sprite shows, lod_sprite::kMaskOwn where the
    // terrain's own texture does. For targets of one sample a pixel.
    void draw_mask(const gl::Target& target, const terrain::Cut& low, std::span<const uint8_t> is_visible,
                   const view::Camera& key, const view::Camera& camera, const terrain::DrawOptions& options);

    // What the last draw sent to the card, and what the sprite takes there.
    uint64_t uploaded_bytes() const { return uploaded_bytes_; }
    uint64_t resident_bytes() const { return uint64_t(width_px_) * height_px_ * 4; }

  private:
    Drawing() = default;
    void copy_colours(const gl::Target& target) const;
    void draw_low(const gl::Target& target, const terrain::Cut& low, std::span<const uint8_t> is_visible, const view::Camera& key,
                  const view::Camera& camera, const terrain::DrawOptions& options, Coordinates coordinates, bool is_mask);

    terrain::Drawing* ground_ = nullptr;
    uint32_t width_px_ = 0, height_px_ = 0;
    gl::Texture sprite_, flags_view_;
    gl::Framebuffer sprite_framebuffer_;
    std::optional<gl::Target> depth_target_;  // one sample a pixel, made when first needed
    gl::StreamBuffer flags_;
    gl::Program program_;
    uint64_t uploaded_bytes_ = 0;
};

}  // namespace overlook::lod_sprite::paper
