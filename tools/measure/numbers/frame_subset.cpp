#include "tools/measure/numbers/frame_subset.h"

#include <algorithm>

namespace overlook::measure {

std::vector<uint32_t> flip_frames(uint32_t frame_count, std::span<const uint32_t> events) {
    std::vector<bool> chosen(frame_count);
    for (uint64_t frame = 0; frame < frame_count; frame += 10) chosen[frame] = true;
    for (uint32_t event : events) {
        if (event >= frame_count) continue;
        chosen[event] = true;
        if (event > 0) chosen[event - 1] = true;
        if (event + 1 < frame_count) chosen[event + 1] = true;
    }
    std::vector<uint32_t> frames;
    for (uint32_t frame = 0; frame < frame_count; ++frame)
        if (chosen[frame]) frames.push_back(frame);
    return frames;
}

std::vector<uint32_t> spread_frames(uint32_t frame_count, uint32_t most) {
    std::vector<uint32_t> frames;
    uint32_t count = std::min(frame_count, most);
    for (uint64_t i = 0; i < count; ++i) frames.push_back(count == 1 ? 0 : uint32_t(i * (frame_count - 1) / (count - 1)));
    return frames;
}

}  // namespace overlook::measure
