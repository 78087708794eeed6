// How sRGB stores light (IEC 61966-2-1): values and linear light, both 0..1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "formats/steady_math.h"

namespace overlook {

inline double linear_from_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : steady::pow((encoded + 0.055) / 1.055, 2.4);
}

inline double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * steady::pow(linear, 1 / 2.4) - 0.055;
}

// Linear light of the values that pictures store, 0..255.
inline const std::array<double, 256>& linear_of_srgb_codes() {
    static const std::array<double, 256> kLinear = [] {
        std::array<double, 256> linear{};
        for (size_t code = 0; code < linear.size(); ++code) linear[code] = linear_from_srgb(double(code) / 255);
        return linear;
    }();
    return kLinear;
}
inline double linear_from_srgb_code(uint8_t code) {
    return linear_of_srgb_codes()[code];
}

}  // namespace overlook
