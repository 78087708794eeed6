#include <algorithm>
#include <cmath>

#include "formats/discrete.h"

namespace overlook::discrete {
namespace {

// Between two poses, turned along the shorter arc.
Pose between(const Pose& a, const Pose& b, float share) {
    return {glm::slerp(a.turn, b.turn, share), glm::mix(a.move_m, b.move_m, share)};
}

}  // namespace

Pose pose_at(const Part& part, double clip_s, double at_s) {
    if (part.at_s.empty()) return {};
    double time_s = clip_s > 0 ? std::fmod(at_s, clip_s) : 0;
    if (time_s < 0) time_s += clip_s;
    size_t after = size_t(std::upper_bound(part.at_s.begin(), part.at_s.end(), float(time_s)) - part.at_s.begin());
    size_t before = after > 0 ? after - 1 : 0;
    after = std::min(after, part.at_s.size() - 1);
    double span_s = double(part.at_s[after]) - double(part.at_s[before]);
    float share = span_s > 0 ? float(std::clamp((time_s - double(part.at_s[before])) / span_s, 0.0, 1.0)) : 0.0f;
    Pose pose = between(part.poses[before], part.poses[after], share);
    pose.turn = glm::normalize(pose.turn);
    pose.move_m += part.pivot_m - pose.turn * part.pivot_m;
    return pose;
}

}  // namespace overlook::discrete
