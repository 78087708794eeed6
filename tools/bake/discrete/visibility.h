// Which places of a thing come first when a level fades in: patterns, pictures, and volumes made for one change of levels.
#pragma once

#include <cstdint>
#include <string>

#include "formats/discrete.h"
#include "formats/result.h"

namespace overlook::discrete {

// The names that visibility_named knows, as people type them: "noise, blue-noise, ...".
std::string visibility_names();

struct VisibilityOptions {
    uint64_t seed = 1;
    double period_m = 1;  // of pictures, > 0; the paper's is 1
};

// Sets a chain's visibility by a name, or from a picture file (anything else). All but `optimised` are one for all changes.
//   noise         64 x 64 values, each as likely as any other (Scherzer and Wimmer 2008, section 4)
//   blue-noise    the same without low frequencies (R. Ulichney, The Void-and-Cluster Method for Dither Array Generation, 1993)
//   checkerboard  8 x 8 squares to a period, 16 grey steps in each kind so that there is more than one moment (figure 5)
//   centre        a volume that grows from the middle of the thing's box outwards, evenly in area
//   optimised     a volume for each change (visibility_optimised.h)
//   none          no visibility at all
// Fails as read_image_rgb8 does, and with Exit::bad_input: "a.png: is 5000 x 10 pixels, at most 4096 a side are visibility".
Result<void> set_visibility(Chain& chain, const std::string& name_or_file, const VisibilityOptions& options);

Visibility white_noise(const VisibilityOptions& options);
Visibility blue_noise(const VisibilityOptions& options);
Visibility checkerboard(const VisibilityOptions& options);
Visibility from_centre(const Chain& chain);

}  // namespace overlook::discrete
