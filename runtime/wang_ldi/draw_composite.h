// A warped picture laid over what OpenGL drew, pixel by pixel, by depth: terrain hides plants, and plants hide terrain.
//
// Based on: J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, section 5.3. Ours: depths are compared
// where they are drawn, without a stencil, and nothing is read back.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "runtime/gl/objects.h"
#include "runtime/gl/program.h"
#include "runtime/gl/target.h"
#include "runtime/view/camera.h"
#include "runtime/wang_ldi/warp.h"

namespace overlook::wang_ldi {

// A context must be current.
class Composite {
  public:
    // Fails with Exit::our_bug.
    static Result<Composite> make();

    // Sends a picture to the card; what is drawn from now on. Returns how many bytes.
    uint64_t take(const Warped& picture);
    // Room for a picture that shaders write: colours (RGBA8, alpha 0 where nothing is) and depths in metres (R32F), top row
    // first.
    void fit(uint32_t width_px, uint32_t height_px);
    GLuint colours() const { return colours_.id(); }
    GLuint depths() const { return depths_.id(); }
    // Draws it into the target, which has its size, or of which it has several times the size both ways: then each sample of the
    // target takes the pixel that it lies in; for a target of one sample, which lies in its pixel's middle, that has to be an odd
    // number of times. The target holds what was drawn for the camera (whose near plane depths are by),
    // and resolves. haze_per_m: of the air before it, as terrain::Drawing's; 0: none.
    void draw(const gl::Target& target, const view::Camera& camera, double haze_per_m) const;

  private:
    Composite() = default;
    gl::Program program_;
    gl::VertexArray nothing_;
    gl::Texture colours_, depths_;
    uint32_t width_px_ = 0, height_px_ = 0;
};

}  // namespace overlook::wang_ldi
