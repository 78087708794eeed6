// One layered depth image of a whole scene, as the paper began with.
//
// Based on: J. Shade, S. Gortler, L. He, R. Szeliski, Layered Depth Images, 1998 (an LDI put together from several depth images);
// J. Shade, M. F. Cohen, D. P. Mitchell, Tiling Layered Depth Images, 2000, figure 2 a and b.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/wang_ldi/warp.h"

namespace overlook::measure::paper::wang {

class OneLdi {
  public:
    // For a perspective camera; empty.
    explicit OneLdi(const view::Camera& camera);

    // Adds what another eye near by sees: a sample for each pixel that shows something, unless there is one in its pixel here at
    // about that depth (within 1 %).
    void add(const view::Camera& camera, const wang_ldi::Warped& seen);

    // Seen from elsewhere, each sample a square as wide as its pixel here is there; nearest ones hide others.
    void draw(const view::Camera& camera, wang_ldi::Warped& picture) const;

    uint64_t sample_count() const;
    uint32_t most_layers() const;  // in a pixel

  private:
    struct Sample {
        glm::dvec3 at_m;
        float depth_m = 0;  // from this image's camera
        uint32_t colour = 0;
    };
    view::Camera camera_;
    std::vector<std::vector<Sample>> pixels_;  // [height, width]
};

// How a picture differs from what should be seen, both of the same camera.
struct Broken {
    double hole_share = 0;   // of the pixels that should show something: nothing is shown
    double wrong_share = 0;  // something more than 5 % nearer or farther
};
Broken broken_of(const wang_ldi::Warped& truth, const wang_ldi::Warped& picture);

}  // namespace overlook::measure::paper::wang
