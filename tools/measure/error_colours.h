// Errors as colours, and where in a picture they are.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/image.h"

namespace overlook::measure {

// The colour of an error of 0..1 (what lies outside is shown as the nearer end): from black by violet and red to pale yellow, the
// lightness growing evenly, so that it reads in grey as well and to the colour-blind. Computed in Oklab (Ottosson 2020), its
// chroma lowered where sRGB has no such colour.
std::array<uint8_t, 3> error_colour(double error);

// map: [height, width], as measure keeps it.
ImageRgb8 error_picture(const std::vector<float>& map, uint32_t width, uint32_t height);

// Where most of the error is: the ninth of the picture with the greatest sum, and its share of the whole.
struct WorstPart {
    std::string name;  // "the upper left", "the middle"
    double share = 0;  // 0..1; 0 for a map without errors
};
WorstPart worst_part(const std::vector<float>& map, uint32_t width, uint32_t height);

}  // namespace overlook::measure
