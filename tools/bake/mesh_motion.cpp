#include "tools/bake/mesh_motion.h"

#include <algorithm>

namespace overlook::mesh {
namespace {

glm::dvec3 stood_up(const glm::dvec3& v) {
    return {v.x, -v.z, v.y};
}

}  // namespace

uint32_t Motion::part_of(uint32_t triangle) const {
    auto after = std::partition_point(ranges.begin(), ranges.end(), [&](const auto& range) { return range.first <= triangle; });
    return after == ranges.begin() ? 0 : std::prev(after)->second;
}

void stand_up(Motion& motion) {
    for (Motion::Part& part : motion.parts) {
        part.pivot_m = stood_up(part.pivot_m);
        for (Motion::Key& key : part.keys) {
            glm::dvec3 axis = stood_up({key.turn.x, key.turn.y, key.turn.z});
            key.turn = glm::dquat(key.turn.w, axis.x, axis.y, axis.z);
            key.move_m = stood_up(key.move_m);
        }
    }
}

void scale(Motion& motion, double scale) {
    for (Motion::Part& part : motion.parts) {
        part.pivot_m *= scale;
        for (Motion::Key& key : part.keys) key.move_m *= scale;
    }
}

}  // namespace overlook::mesh
