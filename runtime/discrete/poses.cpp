#include "runtime/discrete/poses.h"

#include <algorithm>
#include <cmath>

namespace overlook::discrete {

bool is_animated(const Chain& chain) {
    return chain.clip_s > 0 &&
           std::any_of(chain.parts.begin(), chain.parts.end(), [](const Part& part) { return !part.at_s.empty(); });
}

double clip_begin_s(uint32_t instance, double clip_s) {
    // Shares of the golden ratio lie evenly, however many there are.
    constexpr double kGolden = 0.6180339887498949;
    double turns = instance * kGolden;
    return clip_s * (turns - std::floor(turns));
}

void append_poses(const Chain& chain, double at_s, std::vector<PartPose>& poses) {
    for (const Part& part : chain.parts) {
        Pose pose = pose_at(part, chain.clip_s, at_s);
        glm::dquat turn(pose.turn);
        glm::dvec3 move_m = turn * chain.origin_m + glm::dvec3(pose.move_m) - chain.origin_m;
        poses.push_back({{pose.turn.x, pose.turn.y, pose.turn.z, pose.turn.w}, glm::vec4(glm::vec3(move_m), 0)});
    }
}

}  // namespace overlook::discrete
