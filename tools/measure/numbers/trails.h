// What is still seen of moving things where they have been.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/image.h"
#include "tools/measure/frame.h"

namespace overlook::measure {

struct TrailErrors {
    uint64_t trail_px = 0, ghost_px = 0;
    std::vector<uint8_t> is_ghost;  // [height, width]
};

// truth: the frame as it should be. ids_before: [frames][height, width] of the frames before it as they should have been.
// is_moving: by id; ids beyond it rest. A pixel is on a trail where something moving was in one of the frames before, and nothing
// moving is in the truth within margin_px of it. It is a ghost where its colour in `test` lies outside of all that the truth has
// within margin_px of it, by more than kGhostGrey of 255 in one of red, green and blue: of a thing that is where it should be
// within the margin, blended with what is round it, no colour does.
constexpr int kGhostGrey = 24;
TrailErrors trail_errors(const ImageRgb8& test, const Frame& truth, std::span<const std::vector<uint32_t>> ids_before,
                         std::span<const uint8_t> is_moving, uint32_t margin_px);

}  // namespace overlook::measure
