// One perspective layered depth image of all that stands on a ground, and pictures of it by rays.
//
// Based on: J. Shade, S. Gortler, L. He, R. Szeliski, Layered Depth Images, 1998, section 4 (what several eyes see, put into the
// pixels of one camera, where places about as deep become one sample; rays from eyes about the camera's own). Different: of
// places that become one the first is kept, not their mean, and nothing is put before what the camera's own ray meets, so that
// its own picture stays as it is; light is calculated of what is kept, and for the camera's own eye.
#pragma once

#include <cstdint>
#include <functional>

#include "formats/wang_scene.h"
#include "tools/bake/wang_ldi/shade.h"
#include "tools/bake/wang_ldi/stage.h"

namespace overlook::wang_ldi {

// What becomes samples: the first surface along each ray of every eye, or all surfaces along the rays of the camera itself,
// through the middles of its pixels.
enum class Layers { seen, all };

struct PerspectiveOptions {
    uint64_t seed = 1;          // of eyes and light
    uint32_t eyes = 64;         // the first one is the camera's own, with rays through the middles of pixels; 1: its picture
    double cell_m = 0.3;        // the others are off it by so much at most, along each axis
    double merge_share = 0.01;  // places whose depths differ by no more than this share of the nearer become one
    Layers layers = Layers::seen;
    bool is_unlit = false;  // colours are the surfaces' own
};

struct PerspectiveMade {
    PerspectiveLdi image;         // its normals left out where there is one eye, whose picture it is
    uint64_t rays = 0, hits = 0;  // hits: within the picture and its depths
};

// Same arguments, same image with any number of threads. progress: called by this thread with the share that is done. Fails with
// Exit::impossible: "more than 33,554,432 samples; ask for fewer eyes or let deeper differences be one sample (--scene-merge)",
// "there is not enough memory for the samples of a scene".
Result<PerspectiveMade> perspective_of(const Models& models, const TraceStage& stage, const PerspectiveView& view,
                                       const PerspectiveOptions& options, const Light& light,
                                       const std::function<void(double)>& progress);

}  // namespace overlook::wang_ldi
