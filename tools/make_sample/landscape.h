// A generated landscape: a mountain range lifted over a foreland with hills, a plain and a lake, or between two plains, and worn
// down by rivers.
#pragma once

#include <cstdint>
#include <vector>

namespace overlook::sample {

constexpr uint32_t kLeastSide = 33;
constexpr uint32_t kGreatestSide = 4097;
constexpr double kHeightStepM = 1.0 / 32;  // every height is a multiple of it

enum class Relief {
    front,    // a plain in the south-west, the range in the north-east
    between,  // a range from west to east, the wider plain north of it and the narrower one south
};

struct LandscapeOptions {
    uint64_t seed = 1;
    uint32_t side = 1025;     // samples a side, kLeastSide..kGreatestSide
    double cell_size_m = 30;  // 1..1000
    Relief relief = Relief::front;
};

// height_m: [side, side] row-major, north first. Every sample drains: filling its depressions from the border
// changes nothing (lakes lie level with their outlet). No sample stands more than slope_limit * distance (and
// one kHeightStepM of rounding) over any of its eight neighbours.
struct Landscape {
    uint32_t side = 0;
    std::vector<float> height_m;
    double slope_limit = 0;  // tangent
};

// The same bytes for the same options, with any number of threads and any compiler. 8 to 16 s for 1025 a side
// on two cores. O(n log n), about 100 bytes a sample.
Landscape make_landscape(const LandscapeOptions& options);

}  // namespace overlook::sample
