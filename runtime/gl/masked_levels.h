// The smaller levels of a picture whose opacity is held against a threshold.
//
// Based on: I. Castano, Computing Alpha Mipmaps, 2010 (each level's opacity is scaled until as much of it is over the threshold
// as of the whole picture); else what is thin is gone where it is small, and what is dense has no holes.
#pragma once

#include <vector>

#include "runtime/gl/png.h"

namespace overlook::gl {

// Which share of a picture's area has an opacity, taken between the four pixels round a place, of at least `cutoff`: at 16 places
// of each pixel. The picture repeats beyond its edges.
double opaque_share(const ImageRgba8& image, float cutoff);

// Level 1 and so on, each half as large, rounded down, to a single pixel. Colours are means in linear light, weighted by opacity
// (by nothing where all is transparent); opacities are means, scaled so that opaque_share is as near to the picture's own as 8
// bits allow, and not 0 where the picture's is not.
std::vector<ImageRgba8> masked_levels(const ImageRgba8& image, float cutoff);

}  // namespace overlook::gl
