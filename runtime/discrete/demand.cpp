#include "runtime/discrete/demand.h"

#include <array>

namespace overlook::discrete {

void Demand::add(const Selector& selector, const Placement& placement, std::optional<uint32_t> in_use,
                 const view::Camera& camera) {
    instances_.push_back({in_use, std::nullopt});
    selector.note_strains(placement, now_, ahead_);
    if (!is_drawn_in_part(facts_->levels.front()) || selector.is_within_sides(placement)) return;
    instances_.back().seen_offset = uint32_t(seen_.size());
    std::array<glm::dvec3, 4> sides = view::sides_of(camera);
    for (const LevelFacts& level : facts_->levels) {
        bool is_part = is_drawn_in_part(level);
        seen_.push_back(double(is_part ? seen_count(level.bunches, placement, camera.position_m, sides) : level.triangle_count));
    }
}

double Demand::triangles(double times) const {
    size_t level_count = facts_->levels.size();
    double sum = 0;
    for (size_t i = 0; i < instances_.size(); ++i) {
        std::span<const double> now(now_.data() + i * level_count, level_count), ahead;
        if (!ahead_.empty()) ahead = {ahead_.data() + i * level_count, level_count};
        uint32_t level = wanted_level(settings_, now, ahead, instances_[i].in_use, times);
        const std::optional<uint32_t>& seen = instances_[i].seen_offset;
        sum += seen ? seen_[*seen + level] : double(facts_->levels[level].triangle_count);
    }
    return sum;
}

}  // namespace overlook::discrete
