// Which pictures figures 1, 2 and 5 to 9 are, of which terrain, from where.
#pragma once

#include <vector>

#include "tools/measure/paper/caveclod/draw.h"

namespace overlook::measure::paper::cameras {

// All that can be drawn of a subject: the flyover of its figure (two cameras over Three Lakes, four over the Cliff, three over the
// Canyon, a terrain of another name four), and what its coloured meshes show. Fails with Exit::impossible (targets).
Result<std::vector<Picture>> pictures_of(Subject& subject, const Flying& flying);

}  // namespace overlook::measure::paper::cameras
