// A perspective layered depth image of a whole scene, drawn from elsewhere: what tiles of orthographic ones are compared with.
//
// Based on: J. Shade, S. Gortler, L. He, R. Szeliski, Layered Depth Images, 1998, section 5 (incremental warping, splats from
// depth and normal); L. McMillan, Computing Visibility Without Depth, 1995 (towards the epipole, or away from it). Different:
// splats are squares without a soft rim, and the area that a pixel's patch of surface takes follows exactly from its plane, for
// either camera, where the paper looks it up by rounded normals.
#pragma once

#include "formats/wang_scene.h"
#include "runtime/view/camera.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

view::Camera camera_of(const PerspectiveView& view);

// In which order an image's pixels hide nothing after them, for an eye elsewhere: by rows, in each by columns, towards the pixel
// that sees the eye, or, of an eye behind the image's own, away from it. column, row: of that pixel; -1 or as many as there are:
// beyond the image.
struct Epipole {
    int64_t column = 0, row = 0;
    bool is_towards = true;
};
Epipole epipole_of(const PerspectiveView& view, const glm::dvec3& eye_m);
// The i-th of `count` rows or columns, `epipole` of them in the middle.
uint32_t in_order(uint32_t i, int64_t epipole, bool is_towards, uint32_t count);

// How large samples are drawn, beside what their patches say, before sides are rounded to whole pixels.
struct PatchRule {
    float scale = 1;
    float wider_px = 0.45f;  // below half a pixel, so that one of one pixel stays; patches stretched a little leave no gaps then
};

// An image, ready to be warped.
class PerspectiveWarper {
  public:
    explicit PerspectiveWarper(const PerspectiveLdi& image);

    // Draws over what is there, as warp() does tiles: by order, what is drawn last is seen; by depth, what is nearest. A sample
    // is a square as large as the plane patch that its pixel sees looks from there, of 1 to 64 pixels a side. From the image's
    // own camera it is the pixel itself. O(samples + pixels written).
    WarpCounts warp(const view::Camera& camera, Hiding hiding, Warped& picture, const PatchRule& rule = {}) const;

    const PerspectiveView& view() const { return view_; }

  private:
    struct Sample {
        float depth_m = 0;
        uint32_t colour = 0;  // as of Warped
        glm::vec3 normal{0};  // of length 1; 0: none is known, and the patch faces every eye alike
        float facing = 0;     // its product with the pixel's ray
    };
    template <class Brush>
    void draw(const view::Camera& camera, const PatchRule& rule, Brush& brush) const;

    PerspectiveView view_;
    std::vector<uint32_t> first_;
    std::vector<Sample> samples_;
};

}  // namespace overlook::wang_ldi
