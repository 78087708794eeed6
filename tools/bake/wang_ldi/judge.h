// How an image, warped, differs from what rays say, over views of its cell.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/image.h"
#include "formats/wang_ldi.h"
#include "runtime/view/camera.h"
#include "runtime/wang_ldi/warp.h"
#include "tools/bake/wang_ldi/shade.h"

namespace overlook::wang_ldi {

struct Judging {
    uint64_t seed = 1;
    uint32_t views = 4;
    uint32_t size_px = 256;  // of the pictures, at the set's focal length, about the tile's middle
    float splat_scale = 1;   // of the warper
};

// Counts are over all views: pixels whose ray meets the tile first, away from the tile's outline (all eight around meet it too).
struct Judgement {
    uint64_t pixels = 0;
    uint64_t holes = 0;     // nothing is drawn
    uint64_t deeper = 0;    // what is drawn is more than 2 % and two pixels of the level deeper
    uint64_t nearer = 0;    // or so much nearer
    double mean_error = 0;  // of |luma - luma| of what is drawn, 0..1, sRGB-encoded
    double p99_error = 0;
};

// What rays say: pixels as Warped, of the tile alone (its square), everything else hiding it. Lit, or the albedo where the set
// has normals.
Warped traced(const Models& models, const TraceStage& stage, const ImageSet& set, const view::Camera& camera, const Light& light,
              uint64_t seed);

// A view of the wedge of (level, direction): its eye anywhere in it.
view::Camera view_of(const ImageSet& set, uint32_t level, uint32_t direction, const Judging& judging, uint32_t view);

Judgement judged(const Models& models, const TraceStage& stage, const ImageSet& set, const Which& which, const Ldi& ldi,
                 const Light& light, const Judging& judging);

// For the eye: nothing becomes the background's grey.
ImageRgb8 picture_of(const Warped& warped);

}  // namespace overlook::wang_ldi
