// A made canyon: a plateau that a river and its tributaries have cut, in ledges of harder and softer rock.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/image.h"

namespace overlook::sample {

// values: [rows, columns] row-major; between samples, x and y in samples. Places outside are those of the border.
double between(std::span<const double> values, uint32_t columns, uint32_t rows, double x, double y);

// The middle half of a square, from north to south.
struct CanyonGround {
    uint32_t side = 0;                                 // samples of the square either way
    std::vector<double> height_of;                     // [side, side] metres
    std::vector<double> river;                         // [side, side] 0..1: how much of a river runs there
    double height_m(double east, double south) const;  // 0..1 over the middle half
};
CanyonGround make_canyon_ground(uint64_t seed);

// 1024 x 512 pixels, lit: rock in bands, woods on the high plateau, the river.
ImageRgb8 canyon_picture(const CanyonGround& ground, uint64_t seed);

}  // namespace overlook::sample
