#include "runtime/discrete/select.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace overlook::discrete {
namespace {

double area_m2(const Chain& chain, const Level& level) {
    double sum = 0;
    for (size_t i = 0; i + 2 < level.indices.size(); i += 3) {
        glm::dvec3 a = position_m(chain, level.vertices[level.indices[i]]);
        glm::dvec3 b = position_m(chain, level.vertices[level.indices[i + 1]]);
        glm::dvec3 c = position_m(chain, level.vertices[level.indices[i + 2]]);
        sum += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return sum;
}

}  // namespace

ChainFacts facts_of(const Chain& chain) {
    ChainFacts facts{{}, chain.middle_m, chain.radius_m};
    double area = chain.levels.empty() ? 0 : area_m2(chain, chain.levels[0]);
    double outline = 4 * std::numbers::pi * chain.radius_m;
    for (const Level& level : chain.levels) {
        double share = std::max(level.lost_area_share, level.added_area_share);
        double changed_m = chain.radius_m > 0 ? share * area / outline : 0;
        facts.levels.push_back({level.error_m, changed_m, level.triangle_count(), bunches_of(chain, level)});
    }
    return facts;
}

Placement placement_of(const scene::Transform& transform) {
    double angle = transform.rotation_z_deg * std::numbers::pi / 180;
    const std::array<double, 3>& to = transform.translation_m;
    return {{to[0], to[1], to[2]}, std::cos(angle), std::sin(angle), transform.scale};
}

std::vector<Placement> placements_of(std::span<const scene::Instance> instances, const scene::Transform& whole, double time_s) {
    Placement outer = placement_of(whole);
    if (instances.empty()) return {outer};
    std::vector<Placement> placements;
    placements.reserve(instances.size());
    for (const scene::Instance& instance : instances) {
        Placement inner = placement_of(scene::at_time(instance, time_s));
        placements.push_back({outer.at(inner.translation_m), outer.cosine * inner.cosine - outer.sine * inner.sine,
                              outer.sine * inner.cosine + outer.cosine * inner.sine, outer.scale * inner.scale});
    }
    return placements;
}

double near_plane_m(double radius_m, std::span<const Placement> placements) {
    constexpr double kShare = 1e-5, kMost_m = 0.5, kLeastRadius_m = 1e-6;
    double least_m = std::numeric_limits<double>::infinity();
    for (const Placement& one : placements) least_m = std::min(least_m, std::max(radius_m * one.scale, kLeastRadius_m));
    return std::min(kMost_m, kShare * least_m);
}

namespace {

// The coarsest level whose strains allow it, now(level) and ahead(level); with hysteresis where one is in use.
template <class Now, class Ahead>
uint32_t wanted_by(const SelectSettings& settings, uint32_t level_count, std::optional<uint32_t> in_use, bool knows_ahead,
                   const Now& now, const Ahead& ahead) {
    auto coarsest = [&](uint32_t least, double most_now, double most_ahead) {
        uint32_t level = level_count - 1;
        while (level > least && !(now(level) <= most_now)) --level;
        while (knows_ahead && level > least && !(ahead(level) <= most_ahead)) --level;
        return level;
    };
    double refine = settings.refine_share, coarsen = refine * settings.coarsen_share;
    bool is_too_coarse = in_use && (now(*in_use) > refine || (knows_ahead && ahead(*in_use) > refine));
    if (!in_use || is_too_coarse) return coarsest(0, refine, refine);
    return coarsest(*in_use, knows_ahead ? refine : coarsen, coarsen);
}

}  // namespace

SelectSettings coarser(SelectSettings settings, double times) {
    settings.error_px *= times, settings.size_px *= times, settings.distance_m /= times;
    return settings;
}

uint32_t wanted_level(const SelectSettings& settings, std::span<const double> now, std::span<const double> ahead,
                      std::optional<uint32_t> in_use, double times) {
    return wanted_by(
        settings, uint32_t(now.size()), in_use, !ahead.empty(), [&](uint32_t level) { return now[level] / times; },
        [&](uint32_t level) { return ahead[level] / times; });
}

Selector::Selector(const ChainFacts& facts, const SelectSettings& settings, const view::Camera& camera, const Selector* ahead)
    : facts_(facts),
      ahead_(ahead),
      settings_(settings),
      camera_(camera),
      axes_(view::axes_of(camera)),
      bound_(camera),
      focal_px_(view::focal_px(camera)) {
    double secant = view::corner_secant(camera);
    corner_tangent_ = std::sqrt(secant * secant - 1);
    for (const glm::dvec3& inwards : view::sides_of(camera)) sides_.push_back({inwards, glm::length(inwards)});
}

bool Selector::is_in_view(const Placement& placement) const {
    glm::dvec3 from_eye_m = placement.at(facts_.middle_m) - camera_.position_m;
    double radius_m = facts_.radius_m * placement.scale;
    if (glm::dot(axes_.forward, from_eye_m) < camera_.near_m - radius_m) return false;
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return glm::dot(side.inwards, from_eye_m) >= -radius_m * side.length; });
}

bool Selector::is_within_sides(const Placement& placement) const {
    glm::dvec3 from_eye_m = placement.at(facts_.middle_m) - camera_.position_m;
    double radius_m = facts_.radius_m * placement.scale;
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return glm::dot(side.inwards, from_eye_m) >= radius_m * side.length; });
}

double Selector::error_px(const Placement& placement, uint32_t level) const {
    glm::dvec3 from_eye_m = placement.at(facts_.middle_m) - camera_.position_m;
    double error_m = facts_.levels[level].error_m * placement.scale;
    return bound_(bound_.place_of(from_eye_m), facts_.radius_m * placement.scale, error_m);
}

double Selector::pixel_m(const Placement& placement) const {
    glm::dvec3 from_eye_m = placement.at(facts_.middle_m) - camera_.position_m;
    return std::max(glm::dot(axes_.forward, from_eye_m), camera_.near_m) / focal_px_;
}

Selector::Sight Selector::sight_of(const Placement& placement) const {
    glm::dvec3 from_eye_m = placement.at(facts_.middle_m) - camera_.position_m;
    Sight sight;
    sight.scale = placement.scale, sight.radius_m = facts_.radius_m * placement.scale;
    if (settings_.criterion == Criterion::distance || settings_.criterion == Criterion::size) {
        double distance_m = std::max(glm::length(from_eye_m), 1e-12);
        bool is_by_distance = settings_.criterion == Criterion::distance;
        sight.share =
            is_by_distance ? settings_.distance_m / distance_m : 2 * sight.radius_m * focal_px_ / distance_m / settings_.size_px;
        return sight;
    }
    sight.place = bound_.place_of(from_eye_m);
    sight.allowed_px = settings_.error_px;
    if (settings_.criterion == Criterion::importance) {
        // By what of it is nearest to the frame's middle.
        double side_m = std::max(std::hypot(sight.place.right, sight.place.up) - sight.radius_m, 0.0);
        double tangent = side_m / std::max(sight.place.forward + sight.radius_m, camera_.near_m);
        sight.allowed_px *= 1 + settings_.periphery * std::min(tangent / corner_tangent_, 1.0);
    }
    return sight;
}

double Selector::strain(const Sight& sight, uint32_t level) const {
    if (level == 0) return 0;
    if (settings_.criterion == Criterion::distance || settings_.criterion == Criterion::size)
        return std::ldexp(sight.share, int(level) - 1);
    const LevelFacts& facts = facts_.levels[level];
    double error_m = std::max(facts.error_m, settings_.area_weight * facts.area_error_m) * sight.scale;
    return bound_(sight.place, sight.radius_m, error_m) / sight.allowed_px;
}

uint32_t Selector::wanted_of(const Placement& placement, std::optional<uint32_t> in_use) const {
    std::optional<Sight> here, there;
    auto now = [&](uint32_t level) {
        if (!here) here = sight_of(placement);
        return strain(*here, level);
    };
    auto ahead = [&](uint32_t level) {
        if (!there) there = ahead_->sight_of(placement);
        return ahead_->strain(*there, level);
    };
    return wanted_by(settings_, uint32_t(facts_.levels.size()), in_use, knows_ahead(), now, ahead);
}

void Selector::note_strains(const Placement& placement, std::vector<double>& now, std::vector<double>& ahead) const {
    Sight here = sight_of(placement);
    for (uint32_t level = 0; level < facts_.levels.size(); ++level) now.push_back(strain(here, level));
    if (!knows_ahead()) return;
    Sight there = ahead_->sight_of(placement);
    for (uint32_t level = 0; level < facts_.levels.size(); ++level) ahead.push_back(ahead_->strain(there, level));
}

}  // namespace overlook::discrete
