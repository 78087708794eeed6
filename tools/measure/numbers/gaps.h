// Gaps: where the ground shows through what covers it, how many pixels and how large.
#pragma once

#include <cstdint>
#include <vector>

namespace overlook::measure {

struct Gaps {
    uint64_t covered_px = 0;  // looked at: covered in truth, and so is every pixel that touches it
    uint64_t gap_px = 0;      // of those, where the ground shows
    uint32_t widest_px = 0;   // side of the largest square of them
    uint32_t largest_px = 0;  // pixels of the largest gap; pixels that touch at a side belong together

    double share() const { return covered_px > 0 ? double(gap_px) / double(covered_px) : 0; }
    void add(const Gaps& other);  // of another picture
};

// truth, test: [height, width], not 0 where something covers the ground. asked: likewise, which pixels are looked at; empty: all.
// A pixel of the picture's outline has fewer that touch it. O(pixels).
Gaps gaps_of(const std::vector<uint8_t>& truth, const std::vector<uint8_t>& test, uint32_t width_px,
             const std::vector<uint8_t>& asked = {});

}  // namespace overlook::measure
