// FP and FN: image reuse where the surface was hidden (ghosts), none where it was visible (losses).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace overlook::measure {

struct ReuseErrors {
    size_t surface_px = 0, ghosts_px = 0, losses_px = 0;
    double ghost_share = 0, loss_share = 0;  // of the surface's pixels, 0..1; 0 without any
};

// [height, width] each, not 0 = yes: the pixel shows a surface; its colour came from the sprite; the surface was visible from the
// keyframe. Pixels without a surface do not count.
ReuseErrors reuse_errors(std::span<const uint8_t> surface, std::span<const uint8_t> used, std::span<const uint8_t> visible);

}  // namespace overlook::measure
