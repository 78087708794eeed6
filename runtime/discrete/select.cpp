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

uint32_t Selector::coarsest(const Placement& placement, uint32_t least, double most_now, double most_ahead) const {
    uint32_t level = uint32_t(facts_.levels.size()) - 1;
    if (level <= least) return least;
    Sight now = sight_of(placement);
    while (level > least && !(strain(now, level) <= most_now)) --level;
    if (level <= least || ahead_ == nullptr) return level;
    Sight then = ahead_->sight_of(placement);
    while (level > least && !(ahead_->strain(then, level) <= most_ahead)) --level;
    return level;
}

uint32_t Selector::wanted(const Placement& placement) const {
    return coarsest(placement, 0, settings_.refine_share, settings_.refine_share);
}

uint32_t Selector::wanted(const Placement& placement, uint32_t level) const {
    bool is_too_coarse = strain(placement, level) > settings_.refine_share ||
                         (ahead_ != nullptr && ahead_->strain(placement, level) > settings_.refine_share);
    if (is_too_coarse) return wanted(placement);
    double coarsen = settings_.refine_share * settings_.coarsen_share;
    return coarsest(placement, level, ahead_ != nullptr ? settings_.refine_share : coarsen, coarsen);
}

}  // namespace overlook::discrete
