// How sRGB stores light (IEC 61966-2-1): values and linear light, both 0..1.
#pragma once

#include "formats/steady_math.h"

namespace overlook {

inline double linear_from_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : steady::pow((encoded + 0.055) / 1.055, 2.4);
}

inline double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * steady::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace overlook
