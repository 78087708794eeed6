#include "tools/make_sample/sunflower.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_textures.h"

namespace overlook::sample {
namespace {

constexpr double kBelowGround_m = 0.02;
constexpr double kNeckFrom = 0.82;  // share of the stem above which it bends to the head
constexpr uint32_t kStemRings = 64, kStemSides = 12;

// Integrates to 1 over the neck.
double neck_bend(double share) {
    double x = std::clamp((share - kNeckFrom) / (1 - kNeckFrom), 0.0, 1.0);
    return 6 * x * (1 - x) / (1 - kNeckFrom);
}

struct Sway {
    double amount_rad, phase, heading_rad;
};

Spine stem_of(const Sunflower& sunflower, double length_m, const glm::dvec3& facing, const Sway& sway) {
    glm::dvec3 bend = glm::cross(glm::dvec3(0, 0, 1), facing) * sunflower.tilt_rad;
    glm::dvec3 wander(std::cos(sway.heading_rad), std::sin(sway.heading_rad), 0);
    Frame foot = frame_of({0, 0, -kBelowGround_m}, glm::dvec3(0, 0, 1) - wander * (0.25 * sway.amount_rad), {0, -1, 0});
    return Spine(foot, length_m, 96, [&](double share, const Frame&) {
        double wave = std::sin(kTurn_rad * (1.3 * share + sway.phase)) + 0.35 * std::sin(kTurn_rad * (5.1 * share - sway.phase));
        return bend * neck_bend(share) + glm::cross(glm::dvec3(0, 0, 1), wander) * (sway.amount_rad * wave);
    });
}

}  // namespace

Result<std::vector<mesh::Surface>> sunflower_surfaces(uint64_t seed, bool has_leaf_cards) {
    Result<mesh::Surface> made[] = {
        painted("stem", Skin::closed, 32, 128, stalk_paint(seed + 1, {0.42, 0.46, 0.25}, {0.47, 0.56, 0.27})),
        has_leaf_cards ? painted("leaf-card", Skin::masked, 512, 256, heart_leaf_paint(seed + 2))
                       : painted("leaf", Skin::two_sided, 512, 256, heart_leaf_paint(seed + 2)),
        painted("rays", Skin::two_sided, 256, 128, ray_paint(seed + 3)),
        painted("disc", Skin::closed, 64, 64, disc_paint(seed + 4))};
    std::vector<mesh::Surface> surfaces;
    for (Result<mesh::Surface>& surface : made) {
        if (!surface) return tl::unexpected(surface.error());
        surfaces.push_back(std::move(*surface));
    }
    return surfaces;
}

Sunflower sunflower_of(uint64_t seed, int number) {
    static constexpr std::array<double, kSunflowers> kAges{0.04, 0.5, 0.3, 0.62, 0.9, 0.4, 0.18, 0.55, 0.74, 0.46, 1.0};
    Dice dice(hash_of(seed, 100, uint64_t(number)));
    Sunflower sunflower;
    sunflower.age = kAges[size_t(number)];
    // Every model in a tenth of the heights of its own.
    double place = (number * 7 % kSunflowers + dice.unit()) / kSunflowers;
    sunflower.height_m = 1.5 + 0.8 * place;
    double nod = smooth_step(0.6, 1, sunflower.age), rise = 1 - smooth_step(0, 0.3, sunflower.age);
    sunflower.tilt_rad = 1.22 + 0.9 * nod - 0.5 * rise + dice.between(-0.14, 0.14);
    sunflower.disc_radius_m = (0.062 + 0.03 * smooth_step(0, 0.5, sunflower.age)) * dice.between(0.9, 1.12);
    sunflower.leaf_count = 15 + dice.below(5);
    sunflower.has_leaf_cards = number == 5 || number == 9;
    return sunflower;
}

mesh::Mesh sunflower_mesh(const Sunflower& sunflower, uint64_t seed, const std::vector<mesh::Surface>& surfaces) {
    Dice dice(seed);
    PlantMaker maker(surfaces);
    double heading = -kFieldTurn_rad / 2 + dice.between(-0.35, 0.35);
    glm::dvec3 facing(std::sin(heading), -std::cos(heading), 0);
    Sway sway{dice.between(0.10, 0.22), 0, 0};
    sway.phase = dice.unit(), sway.heading_rad = dice.between(0, kTurn_rad);

    // The same curve, as long as its height wants it: of a head aside its rim is the highest, of one that nods its neck.
    double aside = std::max(0.0, std::sin(std::min(sunflower.tilt_rad, 1.9))) * 1.9 * sunflower.disc_radius_m;
    Spine unit = stem_of(sunflower, 1, facing, sway);
    double top = 0;
    for (int i = 0; i <= 40; ++i) top = std::max(top, unit.at(0.8 + 0.005 * i).at_m.z + kBelowGround_m);
    double neck_top = std::max(top, unit.at(1).at_m.z + kBelowGround_m);
    double length_m = (sunflower.height_m + kBelowGround_m - aside * (sunflower.tilt_rad < 1.9 ? 1 : 0.3)) / neck_top;
    Spine stem = stem_of(sunflower, length_m, facing, sway);

    double thick_m = 0.0075 + 0.0045 * sunflower.height_m * dice.between(0.9, 1.1), neck_m = 0.55 * thick_m;
    double knots = dice.unit();
    auto radius_m = [&](double share) {
        double knot = 0.05 * std::sin(kTurn_rad * (11 * share + knots));
        return glm::mix(thick_m, neck_m, std::pow(share, 0.8)) * (1 + knot) * (1 + 0.45 * std::exp(-30 * share));
    };
    maker.add_stalk(kStem, stem, {kStemRings, kStemSides, radius_m, {0.02, 0.01}, {0.98, 0.99}, false});
    add_heart_leaves(maker, sunflower, stem, dice);
    add_head(maker, sunflower, stem.at(1), neck_m, dice);
    return maker.take();
}

}  // namespace overlook::sample
