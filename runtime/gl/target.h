// A picture to draw into, off screen: 8-bit colour and 32-bit floating depth, with any number of samples a pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/image.h"
#include "formats/result.h"
#include "runtime/gl/objects.h"

namespace overlook::gl {

// Makes what is drawn next go into a framebuffer of this size: whole viewport, reversed depth (near 1, far 0) from zero to one,
// depths written and tested, no blending, colours as they are.
void bind_for_drawing(GLuint framebuffer, uint32_t width_px, uint32_t height_px);

class Target {
  public:
    // width_px, height_px >= 1; samples >= 1 (antialiasing). Fails with Exit::impossible if the renderer cannot:
    // "pictures of 99999 x 99999 pixels are too large for this renderer (16384 at most)".
    static Result<Target> make(uint32_t width_px, uint32_t height_px, uint32_t samples);

    uint32_t width_px() const { return width_px_; }
    uint32_t height_px() const { return height_px_; }
    uint32_t samples() const { return samples_; }

    // Makes what is drawn next go here: framebuffer, whole viewport, reversed depth (near 1, far 0) from zero to one.
    void bind() const;
    // Becomes what another framebuffer of the same size and samples shows in its first colour and its depth, which are of the
    // same formats: GL_RGBA8 and GL_DEPTH_COMPONENT32F.
    void copy_from(GLuint framebuffer) const;
    // Averages the samples of a pixel into the picture that read() and show() take. To be called after drawing.
    void resolve() const;
    // The picture, top row first. Waits until everything is drawn.
    ImageRgb8 read() const;
    // What the depth buffer holds, [height, width] top row first: near_m / depth (view::projection), 0 where nothing is drawn.
    // Only of a target with one sample a pixel, which lies in the pixel's middle. Waits as read() does.
    std::vector<float> read_depth() const;
    // Copies the picture into the window's own framebuffer, whose size may differ.
    void show(uint32_t window_width_px, uint32_t window_height_px) const;

  private:
    uint32_t width_px_ = 0, height_px_ = 0, samples_ = 1;
    Framebuffer drawn_, resolved_;
    Renderbuffer drawn_colour_, drawn_depth_, resolved_colour_;
};

}  // namespace overlook::gl
