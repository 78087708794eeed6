// On which frames what is dear is taken: FLIP, and G.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace overlook::measure {

// Every tenth of frame_count frames from the first, and three round each event: the frame, the one before and the one after.
// events: frames of the events of *all* methods of a run, in any order; those past the end do not count. Ascending, each once.
std::vector<uint32_t> flip_frames(uint32_t frame_count, std::span<const uint32_t> events);

// At most `most` >= 2 of frame_count frames, evenly spread from the first to the last. Ascending, each once.
std::vector<uint32_t> spread_frames(uint32_t frame_count, uint32_t most);

}  // namespace overlook::measure
