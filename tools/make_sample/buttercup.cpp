#include <algorithm>
#include <cmath>

#include "tools/make_sample/meadow.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_shapes.h"
#include "tools/make_sample/plant_textures.h"

namespace overlook::sample {
namespace {

enum : uint32_t { kLeaves, kStalks, kPetals };

glm::dvec3 outward(const Frame& frame, double angle) {
    return std::cos(angle) * frame.side() - std::sin(angle) * frame.face;
}

// A palmate leaf as a card that bends.
void add_leaf_card(PlantMaker& maker, const Frame& foot, double size_m, Dice& dice) {
    double bend = dice.between(0.5, 1.2), fold = dice.between(0.05, 0.4);
    Spine midrib(foot, size_m, 8, [&](double s, const Frame& frame) { return droop(frame, bend * 1.6 * s); });
    maker.add_blade(kLeaves, midrib,
                    {3,
                     4,
                     [=](double) { return 0.5 * size_m; },
                     [=](double a, double) { return size_m * fold * (0.5 * std::abs(a) - 0.3 * a * a); },
                     {0, 1},
                     {1, 0}});
}

void add_stalked_leaf(PlantMaker& maker, double angle, double stalk_m, double size_m, Dice& dice) {
    glm::dvec3 out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    double rise = dice.between(0.75, 1.2), sag = dice.between(0.3, 0.9);
    Frame foot = frame_of(0.005 * out - 0.006 * up, std::cos(rise) * out + std::sin(rise) * up,
                          std::cos(rise) * up - std::sin(rise) * out);
    Spine stalk(foot, stalk_m, 8, [&](double, const Frame& frame) { return droop(frame, sag); });
    maker.add_stalk(kStalks, stalk, {4, 4, [](double s) { return 0.0012 - 0.0004 * s; }, {0.05, 0.1}, {0.95, 0.9}, false});
    Frame blade = stalk.at(1);
    add_leaf_card(maker, turned(blade, droop(blade, 0.5)), size_m, dice);
}

void add_petal(PlantMaker& maker, const Frame& flower, double angle, double length_m, double opened, Dice& dice) {
    double rise = glm::mix(1.45, 0.45, opened) + dice.between(-0.1, 0.1),
           curl = glm::mix(0.6, 0.35, opened) + dice.between(-0.15, 0.1);
    glm::dvec3 out = outward(flower, angle), axis = flower.along;
    Frame foot = frame_of(flower.at_m + 0.09 * length_m * out, std::cos(rise) * out + std::sin(rise) * axis,
                          std::cos(rise) * axis - std::sin(rise) * out);
    foot = turned(foot, foot.along * dice.between(-0.15, 0.15));
    Spine spine(foot, length_m, 10, [&](double, const Frame& frame) { return frame.side() * curl; });
    double wide_m = 0.52 * length_m;
    Blade blade{4, 4, {}, {}, {0.03, 0.01}, {0.97, 0.99}};
    blade.half_width_m = [=](double s) {
        return wide_m * std::max(0.14, 1.04 * std::sqrt(std::max(0.0, 1 - std::pow(2 * std::pow(s, 0.75) - 1.12, 2.0))));
    };
    blade.lift_m = [=](double a, double s) { return 0.32 * wide_m * a * a * s; };
    maker.add_blade(kPetals, spine, blade);
}

// A green knob of carpels in a ring of stamens.
void add_middle(PlantMaker& maker, const Frame& flower, double size_m, Dice& dice) {
    maker.add_round(kStalks, 2, 7,
                    [&](uint32_t row, uint32_t side) {
                        double round = double(side) / 7, wide = size_m * (row == 0 ? 0.15 : row == 1 ? 0.17 : 0.1);
                        return Place{
                            flower.at_m + wide * outward(flower, kTurn_rad * round) + flower.along * (size_m * 0.12 * row),
                            {1 - std::abs(2 * round - 1), 0.7 + 0.1 * row}};
                    },
                    {flower.at_m + flower.along * (0.3 * size_m), {0.5, 0.98}});
    for (uint32_t i = 0; i < 20; ++i) {
        double angle = kGoldenAngle_rad * i, lean = dice.between(0.35, 0.8), tall_m = size_m * dice.between(0.34, 0.46);
        glm::dvec3 out = outward(flower, angle);
        Frame foot = frame_of(flower.at_m + 0.14 * size_m * out, std::cos(lean) * flower.along + std::sin(lean) * out, out);
        Spine spine(foot, tall_m, 3, [](double, const Frame&) { return glm::dvec3(0); });
        maker.add_blade(kPetals, spine,
                        {1, 1, [=](double s) { return size_m * (s > 0.4 ? 0.035 : 0.012); }, {}, {0.3, 0.1}, {0.7, 0.45}});
    }
}

void add_flower(PlantMaker& maker, const Frame& flower, double opened, Dice& dice) {
    double length_m = dice.between(0.0105, 0.0135) * (0.75 + 0.25 * opened), turn = dice.between(0, kTurn_rad);
    for (uint32_t i = 0; i < 5; ++i) {
        double angle = turn + kTurn_rad * i / 5 + dice.between(-0.1, 0.1);
        add_petal(maker, flower, angle, length_m * dice.between(0.92, 1.06), opened, dice);
        // Sepals between the petals, under them.
        double rise = glm::mix(1.2, 0.15, opened);
        glm::dvec3 out = outward(flower, angle + 0.63);
        Frame foot =
            frame_of(flower.at_m + 0.1 * length_m * (out - flower.along), std::cos(rise) * out + std::sin(rise) * flower.along,
                     std::cos(rise) * flower.along - std::sin(rise) * out);
        Spine spine(foot, 0.55 * length_m, 4, [](double, const Frame& frame) { return frame.side() * 0.5; });
        maker.add_blade(
            kStalks, spine,
            {2, 2, [=](double s) { return 0.16 * length_m * std::max(0.08, 1 - s * s); }, {}, {0.1, 0.8}, {0.9, 0.98}});
    }
    if (opened > 0.3) add_middle(maker, flower, length_m, dice);
}

struct Branch {
    Frame foot;
    double length_m, thick_m;
    int order;
};

// Stems fork, with a small divided leaf at each fork and a flower at each end.
void add_branch(PlantMaker& maker, const Branch& branch, Dice& dice) {
    double bend = dice.between(-0.15, 0.2), phase = dice.between(0, kTurn_rad);
    Spine stem(branch.foot, branch.length_m, 14, [&](double s, const Frame& frame) {
        return droop(frame, -0.5 * (1 - frame.along.z) + bend) + frame.side() * (0.35 * std::sin(6 * s + phase));
    });
    maker.add_stalk(kStalks, stem,
                    {branch.order == 0 ? 10u : 7u,
                     5,
                     [&](double s) { return branch.thick_m * (1 - 0.45 * s); },
                     {0.05, 0.1 + 0.3 * branch.order},
                     {0.95, 0.4 + 0.3 * branch.order},
                     false});
    uint32_t forks = branch.order == 0 ? 2 + dice.below(2) : branch.order == 1 ? dice.below(2) : 0;
    double turn = dice.between(0, kTurn_rad);
    for (uint32_t i = 0; i < forks; ++i) {
        turn += dice.between(1.8, 2.8);
        double lean = dice.between(0.4, 0.75), share = branch.order == 0 ? dice.between(0.5, 0.8) : dice.between(0.35, 0.6);
        Frame on = stem.at(share);
        glm::dvec3 out = outward(on, turn);
        Frame foot = frame_of(on.at_m, std::cos(lean) * on.along + std::sin(lean) * out, out);
        double length_m = branch.length_m * dice.between(0.4, 0.6);
        add_branch(maker, {foot, length_m, 0.7 * branch.thick_m, branch.order + 1}, dice);
        double rise = dice.between(0.4, 0.9), size_m = (branch.order == 0 ? 0.05 : 0.025) * dice.between(0.8, 1.2);
        Frame leaf =
            frame_of(on.at_m, std::cos(rise) * out + std::sin(rise) * on.along, std::cos(rise) * on.along - std::sin(rise) * out);
        add_leaf_card(maker, leaf, size_m, dice);
    }
    Frame end = stem.at(1);
    add_flower(maker, end, dice.unit() < 0.22 ? dice.between(0, 0.3) : dice.between(0.75, 1.05), dice);
}

}  // namespace

Result<std::vector<mesh::Surface>> buttercup_surfaces(uint64_t seed) {
    Result<mesh::Surface> made[] = {
        painted("palmate-leaf", Skin::masked, 128, 128, palmate_leaf_paint(seed + 1)),
        painted("buttercup-stalk", Skin::two_sided, 16, 64, stalk_paint(seed + 2, {0.36, 0.42, 0.20}, {0.46, 0.58, 0.24})),
        painted("buttercup-petal", Skin::two_sided, 64, 64, buttercup_petal_paint(seed + 3))};
    std::vector<mesh::Surface> surfaces;
    for (Result<mesh::Surface>& surface : made) {
        if (!surface) return tl::unexpected(surface.error());
        surfaces.push_back(std::move(*surface));
    }
    return surfaces;
}

mesh::Mesh buttercup_mesh(uint64_t seed, int number, const std::vector<mesh::Surface>& surfaces) {
    Dice dice(hash_of(seed, 400, uint64_t(number)));
    PlantMaker maker(surfaces);
    double place = (number * 4 % kButtercups + dice.unit()) / kButtercups, height_m = 0.22 + 0.2 * place;
    uint32_t leaves = 4 + dice.below(4);
    for (uint32_t i = 0; i < leaves; ++i) {
        double angle = kGoldenAngle_rad * i + dice.between(-0.4, 0.4), stalk_m = dice.between(0.04, 0.11),
               size_m = dice.between(0.045, 0.075);
        add_stalked_leaf(maker, angle, stalk_m, size_m, dice);
    }
    double lean = dice.between(0, 0.2), heading = dice.between(0, kTurn_rad);
    Frame foot =
        frame_of({0, 0, -0.01},
                 glm::dvec3(std::sin(lean) * std::cos(heading), std::sin(lean) * std::sin(heading), std::cos(lean)), {0, -1, 0});
    add_branch(maker, {foot, height_m, 0.0016, 0}, dice);
    return maker.take();
}

}  // namespace overlook::sample
