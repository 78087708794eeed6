// Ghosts and losses by parallax: how far what a picture shows has moved since the picture was taken.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/measure/frame.h"

namespace overlook::measure {

// Of each pixel of the frame, how far from its place its surface point would be shown by the key's picture if that were only
// turned to where the frame's camera looks: the distance, in the frame's pixels, from the pixel's middle to where the frame's
// camera sees the direction that the point has from the key's camera. So turning and the key's own size and opening do not count,
// and a key taken from the frame's own viewpoint has none. [height, width]; NaN without a surface, infinity where that direction
// is not before the frame's camera.
std::vector<float> parallax_px(const Frame& frame, const view::Camera& key);

// The pixels of one range of parallax, from_px <= parallax < to_px.
struct ParallaxBin {
    double from_px = 0, to_px = 0;
    uint64_t asked_px = 0;                               // a surface, of which a key might have been used
    uint64_t ghosts_px = 0, losses_px = 0, near_px = 0;  // near: drawn as geometry on purpose, not among those asked
    double ghost_share() const { return asked_px > 0 ? double(ghosts_px) / double(asked_px) : 0; }
    double loss_share() const { return asked_px > 0 ? double(losses_px) / double(asked_px) : 0; }
};

// What one pixel was.
enum class Reused : uint8_t { nothing_there, well, ghost, loss, near };

// Sums pixels over frames, in ranges twice as wide each.
class ParallaxTally {
  public:
    static constexpr std::array<double, 8> kEdges_px = {0, 1, 2, 4, 8, 16, 32, 64};  // the last range is open upwards

    ParallaxTally();
    // [height, width] each. A pixel with a surface has a parallax (asserted).
    void add(std::span<const float> parallax_px, std::span<const Reused> pixels);
    std::span<const ParallaxBin> bins() const { return bins_; }
    // All ranges below one of the edges, together.
    ParallaxBin up_to(double edge_px) const;

  private:
    std::array<ParallaxBin, kEdges_px.size()> bins_;
};

}  // namespace overlook::measure
