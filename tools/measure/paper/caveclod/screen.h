// Where each camera's picture lies on the screen, and which frames of the flights are flown.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/image.h"
#include "runtime/view/camera.h"

namespace overlook::measure::paper::cameras {

constexpr uint32_t kMostCameras = 4;

// Of cameras A, B, C, D: one fills the screen; the second takes its top left quarter; three and four have a quadrant each, A and
// B above, C and D below (Kram and Shaw 2002, 4.1). count: 1..4; width_px, height_px >= 2.
std::vector<view::Part> places_of(uint32_t count, uint32_t width_px, uint32_t height_px);

// Pictures of those sizes put together, later ones over earlier ones; black where there is none.
ImageRgb8 composed(const std::vector<ImageRgb8>& pictures, const std::vector<view::Part>& places, uint32_t width_px,
                   uint32_t height_px);

// A stretch of a flight without a gap: frames [begin, end) of it.
struct Clip {
    uint32_t begin = 0, end = 0;
    bool operator==(const Clip&) const = default;
};
constexpr uint32_t kClipFrames = 30;

// `frames` of a flight's all_frames in clips of kClipFrames at most, evenly from its first to its last frame; all of it, without
// gaps, where as many are wanted as there are. Both >= 1.
std::vector<Clip> clips_of(uint32_t all_frames, uint32_t frames);

}  // namespace overlook::measure::paper::cameras
