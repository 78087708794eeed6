// The outline of a heart-shaped leaf with a serrated margin, in the plane: x across, -0.5..0.5, y along the midrib, 0 below
// the lobes and 1 beyond the tip.
#pragma once

#include <glm/glm.hpp>

namespace overlook::sample {

constexpr double kHeartFoot = 0.22;  // y of where the stalk meets the blade

// From the foot to the rim in a direction, 0 towards the tip, pi away from it: the rim between its teeth.
double heart_radius(double angle_rad);
// Lateral veins run from the midrib, share 0 at the foot and 1 near the tip, to the rim of the right half.
glm::dvec2 heart_midrib(double share);
glm::dvec2 heart_rim(double share);
// Which of them passes nearest in the sense of its direction from the foot: 0..1.
double heart_share(const glm::dvec2& at);

constexpr int kHeartVeins = 8;   // on each side, evenly on the shares
constexpr int kHeartTeeth = 16;  // on each side

}  // namespace overlook::sample
