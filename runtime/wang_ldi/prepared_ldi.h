// A layered depth image laid out for fast warping: its samples in the order of rows, each with its column beside its height, so
// that many are brought to a picture at once.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "formats/wang_ldi.h"

namespace overlook::wang_ldi {

struct PreparedLdi {
    // O(samples + pixels). About 6 or 7 bytes a sample and 4 a pixel; the image is not needed any more.
    static PreparedLdi of(const Ldi& ldi);

    uint32_t side_px = 0;
    std::vector<uint32_t> first;           // as Ldi
    std::vector<uint32_t> places;          // column, and 65,536 times the height in steps; kPadding more
    std::vector<uint8_t> colours;          // of palette; kPadding more
    std::vector<uint8_t> splats;           // as Ldi; kPadding more if there are any
    std::vector<uint32_t> palette;         // as of Warped
    std::vector<uint16_t> lowest;          // [side_px] of each row, in steps
    std::vector<uint16_t> highest;         // [side_px]
    static constexpr size_t kPadding = 8;  // so that whole vectors can be read

    uint32_t sample_count() const { return first.empty() ? 0 : first.back(); }
    uint64_t bytes() const;
};

// The prepared image with this number (index_of), or null where it is not at hand. Any thread.
using PreparedAt = std::function<const PreparedLdi*(uint64_t index)>;

}  // namespace overlook::wang_ldi
