// Ghosts and losses of frames that show pictures again: what each picture could have known.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "tools/measure/frame.h"
#include "tools/measure/method.h"
#include "tools/measure/numbers/image_reuse.h"
#include "tools/measure/full_geometry.h"

namespace overlook::measure {

struct Reuse {
    ReuseErrors errors;
    double near_share = 0;          // of the surface's pixels, drawn as geometry on purpose: neither ghosts nor losses
    std::vector<uint8_t> is_ghost;  // [height, width]
    std::vector<uint8_t> is_loss;
};

// [height, width], not 0 = yes: the frame's surface, nearest to the pixel's middle, is in sight of the key. key_depth_m: what the
// key's camera sees of the full geometry, [key.height_px, key.width_px], infinity = nothing. A point is hidden where it lies
// behind all four texels round its place, by more than 0.1 % of its depth and half of what these differ by (that half at most 0.5
// %: slopes, not steps). So within a texel of an outline points count as visible.
std::vector<uint8_t> seen_by(const view::Camera& key, std::span<const float> key_depth_m, const Frame& frame);

// The truth is the full geometry drawn from the key's camera with the key's own texels, and not the depth that the key keeps:
// that one is part of what is judged.
class ReuseTruth {
  public:
    // Uploaded, and outlives this.
    explicit ReuseTruth(World& world);

    // Depth and ids of the full geometry at the pixels' middles; the picture is left out. Fails with Exit::impossible.
    Result<Frame> full_geometry(const view::Camera& camera);
    // truth: depth and ids of the frame as it should be. A ghost was taken from a key that does not see the surface, a loss from
    // none though one of those in use does. Fails with Exit::impossible (targets).
    Result<Reuse> reuse(const Sources& sources, const Frame& truth);

  private:
    static constexpr size_t kMostKept = 8;  // keys are used for many frames

    FullGeometry full_;
    std::deque<Frame> keys_;  // drawn lately
};

}  // namespace overlook::measure
