// A windmill whose sails turn.
#pragma once

#include "tools/make_sample/glb.h"

namespace overlook::sample {

constexpr int kWindmillLevels = 4;
constexpr double kWindmillTurn_s = 12;

// 16 m high to its cap, the foot at the origin, z up, facing south (-y); the sails, 8 m long, are a node of their own that turns
// about its axle. Level 0 has about 18,000 triangles, the last about 100; they are levels as an artist would make them.
std::vector<GlbNode> windmill(int level);

}  // namespace overlook::sample
