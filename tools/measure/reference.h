// The reference: what a frame would look like with all the time in the world.
#pragma once

#include <optional>
#include <string>

#include "runtime/gl/context.h"
#include "tools/measure/frame.h"
#include "tools/measure/full_geometry.h"
#include "tools/measure/world.h"

namespace overlook::measure {

constexpr uint32_t kSupersampling = 4;  // a side: 16 samples a pixel
// Pictures wider or higher are drawn in parts, as few as do and all of one size. It decides the last bits of a picture, and so is
// the same for every renderer: OpenGL 4.5 has targets of kSupersampling times this size everywhere.
constexpr uint32_t kReferencePartPx = 1536;

// Draws references: full geometry at 4 x 4 times the pixels, averaged in linear light, with the look of the methods and depth and
// ids of the pixels' middles. What it holds for the 4 x 4 pixels is bounded, whatever the picture's size. With a folder given,
// each frame is kept there under a name made from the content of all that decides it (scene, camera to the bit, size, shaders,
// renderer, version), and is taken from there the next time.
class ReferenceRenderer {
  public:
    // cache_folder: made already; empty = keep nothing. part_px: the most pixels of a part, each way, 1 .. kReferencePartPx. The
    // world must be uploaded and outlive this. Fails with Exit::impossible if the renderer cannot draw pictures of the size:
    // "pictures of 20000 x 80 pixels are too large for this renderer (16384 at most)".
    static Result<ReferenceRenderer> make(World& world, const gl::Renderer& renderer, uint32_t width_px, uint32_t height_px,
                                          std::string cache_folder, uint32_t part_px = kReferencePartPx);

    // A kept frame that does not have its right checksum is drawn anew and replaced. Fails with Exit::cannot_write.
    Result<Frame> frame(const view::Camera& camera);

    // The same, wider and higher by so many pixels on every side: what stands just outside the picture. Its depth and ids alone;
    // colour is black, nothing is kept. Inside, pixels may differ from frame()'s by rounding. Fails with Exit::impossible.
    Result<Frame> surroundings(const view::Camera& camera, uint32_t margin_px);

    uint64_t drawn_count() const { return drawn_count_; }      // frames drawn
    uint64_t kept_count() const { return kept_count_; }        // frames taken from the folder
    uint64_t damaged_count() const { return damaged_count_; }  // kept frames that were refused

  private:
    ReferenceRenderer(World& world, gl::Target large, gl::Target middle)
        : world_(&world), large_(std::move(large)), middle_(std::move(middle)), full_(world) {}
    Frame drawn(const view::Camera& camera);
    ImageRgb8 part_of(const view::Camera& large_camera, const view::Part& part);

    World* world_;
    gl::Target large_;   // of one part
    gl::Target middle_;  // of the picture
    FullGeometry full_;
    std::string cache_folder_, identity_;
    uint64_t drawn_count_ = 0, kept_count_ = 0, damaged_count_ = 0;
};

}  // namespace overlook::measure
