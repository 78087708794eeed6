// Where the parts of instances are at a time.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "formats/discrete.h"

namespace overlook::discrete {

// As it lies on the graphics card: place = turned + move, both from the chain's origin_m.
struct PartPose {
    glm::vec4 turn{0, 0, 0, 1};  // a quaternion: x, y, z, w
    glm::vec4 move_m{0};         // fourth: 0

    bool operator==(const PartPose&) const = default;
};

// Does anything ever move?
bool is_animated(const Chain& chain);
// How far into the clip an instance is when time begins, so that many do not move in step: 0 <= .. < clip_s.
double clip_begin_s(uint32_t instance, double clip_s);
// Appends one pose a part.
void append_poses(const Chain& chain, double at_s, std::vector<PartPose>& poses);

}  // namespace overlook::discrete
