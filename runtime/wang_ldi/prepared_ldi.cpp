#include "runtime/wang_ldi/prepared_ldi.h"

#include <algorithm>

#include "runtime/wang_ldi/tile_painter.h"

namespace overlook::wang_ldi {

PreparedLdi PreparedLdi::of(const Ldi& ldi) {
    PreparedLdi made;
    made.side_px = ldi.side_px, made.first = ldi.first, made.palette = packed_palette(ldi);
    made.lowest.assign(ldi.side_px, 0xffff), made.highest.assign(ldi.side_px, 0);
    made.places.reserve(ldi.heights.size() + kPadding);
    for (uint32_t row = 0; row < ldi.side_px; ++row)
        for (uint32_t column = 0; column < ldi.side_px; ++column) {
            size_t pixel = size_t(row) * ldi.side_px + column;
            for (uint32_t s = ldi.first[pixel]; s < ldi.first[pixel + 1]; ++s) {
                uint16_t height = ldi.heights[s];
                made.places.push_back(column | uint32_t(height) << 16);
                made.lowest[row] = std::min(made.lowest[row], height), made.highest[row] = std::max(made.highest[row], height);
            }
        }
    made.places.resize(ldi.heights.size() + kPadding);
    made.colours = ldi.colours, made.colours.resize(ldi.colours.size() + kPadding);
    if (!ldi.splats.empty()) made.splats = ldi.splats, made.splats.resize(ldi.splats.size() + kPadding, 16);
    return made;
}

uint64_t PreparedLdi::bytes() const {
    return 4 * (first.size() + places.size() + palette.size()) + colours.size() + splats.size() +
           2 * (lowest.size() + highest.size());
}

}  // namespace overlook::wang_ldi
