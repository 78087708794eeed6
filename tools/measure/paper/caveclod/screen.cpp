#include "tools/measure/paper/caveclod/screen.h"

#include <algorithm>
#include <cassert>

namespace overlook::measure::paper::cameras {

std::vector<view::Part> places_of(uint32_t count, uint32_t width_px, uint32_t height_px) {
    assert(count >= 1 && count <= kMostCameras && width_px >= 2 && height_px >= 2);
    uint32_t half_width = width_px / 2, half_height = height_px / 2;
    if (count == 1) return {{0, 0, width_px, height_px}};
    if (count == 2) return {{0, 0, width_px, height_px}, {0, 0, half_width, half_height}};
    std::vector<view::Part> places;
    for (uint32_t i = 0; i < count; ++i) {
        bool is_right = i % 2 == 1, is_below = i / 2 == 1;
        places.push_back({is_right ? half_width : 0, is_below ? half_height : 0, is_right ? width_px - half_width : half_width,
                          is_below ? height_px - half_height : half_height});
    }
    return places;
}

ImageRgb8 composed(const std::vector<ImageRgb8>& pictures, const std::vector<view::Part>& places, uint32_t width_px,
                   uint32_t height_px) {
    ImageRgb8 screen{width_px, height_px, std::vector<uint8_t>(size_t(3) * width_px * height_px, 0)};
    for (size_t i = 0; i < pictures.size(); ++i) {
        const ImageRgb8& picture = pictures[i];
        const view::Part& place = places[i];
        assert(picture.width == place.width_px && picture.height == place.height_px);
        for (uint32_t row = 0; row < picture.height; ++row) {
            auto from = picture.pixels.begin() + ptrdiff_t(size_t(3) * row * picture.width);
            size_t to = 3 * (size_t(place.top_px + row) * width_px + place.left_px);
            std::copy_n(from, size_t(3) * picture.width, screen.pixels.begin() + ptrdiff_t(to));
        }
    }
    return screen;
}

std::vector<Clip> clips_of(uint32_t all_frames, uint32_t frames) {
    frames = std::min(frames, all_frames);
    uint32_t count = (frames + kClipFrames - 1) / kClipFrames;
    std::vector<Clip> clips;
    for (uint32_t i = 0; i < count; ++i) {
        // Frames i * frames / count and on belong to clip i; the frames left out are shared evenly between the clips.
        uint32_t begin = uint32_t(uint64_t(i) * frames / count), end = uint32_t(uint64_t(i + 1) * frames / count);
        uint32_t gap = count > 1 ? uint32_t(uint64_t(i) * (all_frames - frames) / (count - 1)) : 0;
        clips.push_back({begin + gap, end + gap});
    }
    return clips;
}

}  // namespace overlook::measure::paper::cameras
