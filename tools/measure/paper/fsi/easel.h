// Single pictures of chains: what a buffer of frame-sequential interpolation holds, in true and in false colours.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/image.h"
#include "runtime/discrete/draw_frames.h"

namespace overlook::measure::paper::fsi {

// How a list is painted: fragments that are not visible are left out, as in the paper.
enum class Paint {
    true_colours,
    false_colours,  // the finer level of a change red, the coarser blue
    turned,         // as true_colours, but the visibility is looked up where the animation has moved a place to: the wrong way
    mask,           // white where anything is
    translucent,    // white where something translucent is seen, black where something whole is
};

// A chain on the graphics card and pictures of it. A context must be current.
class Easel {
  public:
    // chain: copied. Fails as discrete::Drawing::make and gl::Target::make.
    static Result<std::unique_ptr<Easel>> make(const discrete::Chain& chain, uint32_t width_px, uint32_t height_px,
                                               uint32_t samples = 4);

    Result<ImageRgb8> paint(const discrete::FrameList& frame, std::span<const discrete::Placement> placements,
                            const view::Camera& camera, double clip_s, Paint paint);
    const discrete::Chain& chain() const { return chain_; }
    const discrete::Drawing& drawing() const { return *drawing_; }
    const gl::Target& target() const { return target_; }
    // Looks at a thing's middle from the south, so far away that it fills about `share` of the picture's height.
    view::Camera camera_at(const discrete::Placement& placement, double share) const;

  private:
    Easel(const discrete::Chain& chain, gl::Target target) : chain_(chain), target_(std::move(target)) {}
    discrete::Chain chain_;
    std::optional<discrete::Drawing> drawing_;
    gl::Target target_;
    discrete::ListBuffers buffers_;
};

// How far a thing's middle is from a camera, in metres.
double away_m(const Easel& easel, const view::Camera& camera, const discrete::Placement& placement);

// A change of level half-way, by the method itself: the lists of the last two frames, and the picture that it made of them.
struct Midway {
    discrete::FrameList older, newer;
    std::vector<discrete::Placement> placements;
    view::Camera camera;
    ImageRgb8 picture;
};
// Everything nearer than distance_m at the camera changes from level change + 1 to level change, as if the camera had come from so
// far behind that all were farther; stops at the first frame whose phase is at least `phase`, 0..1, the camera at rest.
Result<Midway> midway(Easel& easel, discrete::Variant variant, uint32_t change, double distance_m,
                      std::span<const discrete::Placement> placements, const view::Camera& camera, double phase);

// Pictures of one size in rows and columns, white between them. rows: at least one picture, each row as long as the first.
ImageRgb8 montage(const std::vector<std::vector<ImageRgb8>>& rows);
// Mean of both where both masks are white, the one whose mask is where one is, else b.
ImageRgb8 put_together(const ImageRgb8& a, const ImageRgb8& mask_a, const ImageRgb8& b, const ImageRgb8& mask_b);

}  // namespace overlook::measure::paper::fsi
