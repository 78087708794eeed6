// What writer and reader of grouped rows have in common: which group a number is in, and what it is told from. All of it is known
// to a reader before the number itself.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "formats/wang_ldi_grouped.h"

namespace overlook::wang_ldi::groups {

inline uint16_t folded(int difference) {
    auto wrapped = int16_t(uint16_t(difference));
    return uint16_t(uint16_t(wrapped << 1) ^ uint16_t(wrapped >> 15));
}
inline uint16_t unfolded(uint16_t code) {
    return uint16_t((code >> 1) ^ uint16_t(-(code & 1)));
}

constexpr int kMostTold = 32767;  // from more steps nothing is told: folded differences would not fit 16 bits

// What differs from `steps` and is not below 0: as folded() as far as it goes to both sides, itself beyond.
inline uint16_t code_of_gap(int gap, int steps) {
    if (steps < 0 || steps > kMostTold || gap > 2 * steps) return uint16_t(gap);
    return uint16_t(gap >= steps ? 2 * (gap - steps) : 2 * (steps - gap) - 1);
}
inline int gap_of_code(uint16_t code, int steps) {
    int told = steps > kMostTold ? -1 : 2 * steps, turn = -(code & 1);  // without a branch: reading waits for this
    int gap = steps + (((code + 1) / 2 ^ turn) - turn);
    return code > told ? code : gap;
}

// Samples of a pixel: [begin, end).
struct Column {
    uint32_t begin = 0, end = 0;
    uint32_t count() const { return end - begin; }
};

// The pixels in the west and in the south of one; without samples beyond the tile.
struct Beside {
    Column west, south;

    Beside(const Ldi& ldi, size_t pixel) {
        if (pixel % ldi.side_px > 0) west = {ldi.first[pixel - 1], ldi.first[pixel]};
        if (pixel >= ldi.side_px) south = {ldi.first[pixel - ldi.side_px], ldi.first[pixel - ldi.side_px + 1]};
    }
};

inline uint32_t group_of_count(const GroupCounts& groups, const Beside& beside) {
    return uint32_t(std::min<uint64_t>(uint64_t(beside.west.count()) + beside.south.count(), groups.counts - 1));
}

// Of a pixel's lowest sample; before: the lowest of the last pixel with samples, or 0.
inline int lowest_told_from(const Ldi& ldi, const Beside& beside, int before) {
    bool has_west = beside.west.count() > 0, has_south = beside.south.count() > 0;
    int west = has_west ? ldi.heights[beside.west.begin] : before, south = has_south ? ldi.heights[beside.south.begin] : west;
    return has_west ? (west + south) / 2 : south;
}

// Of the others of a pixel, from below: the next sample above in the west or in the south, whichever is lower.
class NextAbove {
  public:
    NextAbove(const Ldi& ldi, const Beside& beside) : ldi_(ldi), west_(beside.west), south_(beside.south) {}
    // below: a height, ascending from call to call. How far above the one that follows it the next is, or -1 if none is.
    int steps(int below) {
        int west = next(west_, below), south = next(south_, below);
        return west < 0 || (south >= 0 && south < west) ? south : west;
    }

  private:
    int next(Column& column, int below) const {
        while (column.begin < column.end && ldi_.heights[column.begin] <= below) ++column.begin;
        return column.begin < column.end ? ldi_.heights[column.begin] - below - 1 : -1;
    }
    const Ldi& ldi_;
    Column west_, south_;
};

constexpr uint32_t kGroupOfLowest = 0;
inline uint32_t group_of_height(const GroupCounts& groups, int steps) {
    return std::min(groups.heights - 1, steps < 0 ? 1 : 1 + uint32_t(std::bit_width(uint32_t(steps) + 1)));
}

// The colour of the sample that is nearest in height, of those in the west and in the south and of the one below; -1: there is
// none. Heights of a pixel come from below.
class NearestColour {
  public:
    NearestColour(const Ldi& ldi, const Beside& beside) : ldi_(ldi), west_(beside.west), south_(beside.south) {}
    int of(uint32_t sample, bool is_lowest) {
        int height = ldi_.heights[sample], distance = 1 << 16, colour = -1;
        look(west_, height, distance, colour), look(south_, height, distance, colour);
        if (!is_lowest && height - ldi_.heights[sample - 1] < distance) colour = ldi_.colours[sample - 1];
        return colour;
    }

  private:
    void look(Column& column, int height, int& distance, int& colour) const {
        while (column.begin + 1 < column.end && ldi_.heights[column.begin + 1] <= height) ++column.begin;
        for (uint32_t s = column.begin; s < std::min(column.end, column.begin + 2); ++s) {
            int away = std::abs(ldi_.heights[s] - height);
            if (away < distance) distance = away, colour = ldi_.colours[s];
        }
    }
    const Ldi& ldi_;
    Column west_, south_;
};

// most: the highest step of the set's heights.
inline uint32_t group_of_colour(const GroupCounts& groups, const Ldi& ldi, int nearest, uint32_t height, uint32_t most) {
    uint32_t band = std::min(groups.colour_bands - 1, height * groups.colour_bands / (most + 1));
    uint32_t of = nearest < 0 ? 0 : uint32_t(nearest) * groups.colour_classes / uint32_t(ldi.palette.size());
    return band * groups.colour_classes + std::min(groups.colour_classes - 1, of);
}

}  // namespace overlook::wang_ldi::groups
