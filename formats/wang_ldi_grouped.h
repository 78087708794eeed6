// An image's bytes before compression where its rows are predicted from neighbours and grouped (flag 4 of WLDI): numbers that are
// alike stand together, so that each group has a code of its own. Documented in formats/spec/wang_ldi.md.
//
// Based on: M. J. Weinberger, G. Seroussi, G. Sapiro, The LOCO-I Lossless Image Compression Algorithm, 2000 (prediction from what
// is known in the west and the south, codes by context). Different: what stands above each other in columns is predicted from the
// columns beside, and contexts are groups, one after the other, for a coder that has none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/wang_ldi_layout.h"

namespace overlook::wang_ldi {

// How many groups there are of each kind in an image of so many samples: few samples do not fill many.
struct GroupCounts {
    uint32_t counts = 1, heights = 2;
    uint32_t colour_classes = 1, colour_bands = 1;  // colours have their product

    constexpr uint32_t colours() const { return colour_classes * colour_bands; }
    constexpr uint32_t all() const { return counts + heights + colours(); }
};
constexpr uint64_t kFewSamples = 1 << 11, kManySamples = 1 << 15;
constexpr GroupCounts group_counts_of(uint64_t samples) {
    if (samples < kFewSamples) return {1, 2, 1, 1};
    if (samples < kManySamples) return {4, 10, 4, 2};
    return {8, 12, 8, 4};
}

struct GroupedBytes {
    std::vector<std::byte> bytes;
    std::vector<size_t> ends;  // where groups end, ascending: good places to begin another code
};
GroupedBytes grouped_bytes_of(const ImageSet& set, uint32_t level, const Ldi& ldi);

// `bytes` are exactly raw_bytes_of the entry's counts and may be hostile otherwise. L11 to L16 but for what fault_of_ldi says.
ImageFault ldi_of_grouped(std::span<const std::byte> bytes, const ImageSet& set, uint32_t level, const Entry& entry, Ldi& ldi);

}  // namespace overlook::wang_ldi
