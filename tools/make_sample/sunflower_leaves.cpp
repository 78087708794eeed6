#include <algorithm>
#include <cmath>

#include "tools/make_sample/heart_leaf.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/sunflower.h"

namespace overlook::sample {
namespace {

constexpr uint32_t kRows = 2 * kHeartTeeth + 1, kColumns = 8, kCardRows = 8, kCardColumns = 6;

// How a blade is laid into space.
struct Leaf {
    double length_m;
    double fold, wave, phase;  // raised sides, an undulating rim
    double u_from;             // of its picture
};

// A place of the leaf's plane in space and on its picture.
Place place_of(const Spine& midrib, const Leaf& leaf, const glm::dvec2& at) {
    Frame frame = midrib.at((at.y - kHeartFoot) / (1 - kHeartFoot));
    double out = std::abs(at.x), side = at.x < 0 ? -1 : 1;
    double lift = leaf.fold * out - 0.5 * leaf.fold * out * out * 2.4;
    lift += leaf.wave * out * out * std::sin(14 * at.y + leaf.phase + 1.7 * side);
    double vein = kHeartVeins * heart_share(at);
    lift += 0.012 * (1 - std::cos(kTurn_rad * vein)) * std::min(1.0, 6 * out);
    // The rim is as far from the midrib as in the plane, however it is lifted.
    double flat = std::sqrt(std::max(0.3, 1 - leaf.fold * leaf.fold));
    return {frame.at_m + leaf.length_m * (at.x * flat * frame.side() + lift * frame.face),
            {leaf.u_from + (0.5 + at.x) / 2, at.y}};
}

void add_cut_leaf(PlantMaker& maker, const Spine& midrib, const Leaf& leaf) {
    maker.add_sheet(kHeartLeaves, kRows, kColumns, [&](uint32_t row, uint32_t column) {
        double share = double(row) / kRows, across = 2.0 * column / kColumns - 1, out = std::abs(across);
        glm::dvec2 rim = heart_rim(share), from = heart_midrib(share);
        bool is_notch = column % kColumns == 0 && row % 2 == 0;
        glm::dvec2 at = glm::mix(from, rim, out * (is_notch ? 0.925 : 0.985));
        return place_of(midrib, leaf, {across < 0 ? -at.x : at.x, at.y});
    });
}

void add_leaf_card(PlantMaker& maker, const Spine& midrib, const Leaf& leaf) {
    maker.add_sheet(kHeartLeaves, kCardRows, kCardColumns, [&](uint32_t row, uint32_t column) {
        return place_of(midrib, leaf, {double(column) / kCardColumns - 0.5, double(row) / kCardRows});
    });
}

}  // namespace

void add_heart_leaves(PlantMaker& maker, const Sunflower& sunflower, const Spine& stem, Dice& dice) {
    double angle = dice.between(0, kTurn_rad);
    double withered = smooth_step(0.65, 1, sunflower.age);
    for (uint32_t i = 0; i < sunflower.leaf_count; ++i) {
        double up = (i + 0.5 + dice.between(-0.2, 0.2)) / sunflower.leaf_count, share = 0.16 + 0.74 * up;
        angle += kGoldenAngle_rad + dice.between(-0.25, 0.25);
        double grown = (0.55 + 0.45 * std::sin(3.1 * std::pow(up, 0.75))) * dice.between(0.85, 1.1);
        if (up > 0.85) grown *= 0.75;
        Leaf leaf{0.33 * grown * (0.7 + 0.15 * sunflower.height_m), 0, 0, 0, 0};
        leaf.fold = dice.between(0.1, 0.4), leaf.wave = dice.between(0.05, 0.16), leaf.phase = dice.between(0, kTurn_rad);
        double old = withered + 0.35 - up;
        leaf.u_from = old + dice.between(-0.15, 0.15) > 0.3 ? 0.5 : 0;

        Frame on = stem.at(share);
        glm::dvec3 out = glm::normalize(std::cos(angle) * on.side() + std::sin(angle) * on.face);
        double rise = dice.between(0.75, 1.05) + 0.25 * up - 0.3 * withered, sag = dice.between(0.2, 0.6);
        Frame foot =
            frame_of(on.at_m, std::cos(rise) * out + std::sin(rise) * on.along, std::cos(rise) * on.along - std::sin(rise) * out);
        double stalk_m = leaf.length_m * dice.between(0.36, 0.56) * (1.1 - 0.4 * up), thick_m = 0.011 * leaf.length_m + 0.0012;
        Spine stalk(foot, stalk_m, 10, [&](double, const Frame& frame) { return droop(frame, sag); });
        maker.add_stalk(kStem, stalk,
                        {6, 6, [&](double s) { return thick_m * (1.5 - 0.7 * s); }, {0.05, 0.55}, {0.95, 0.95}, false});

        double kink = dice.between(0.45, 1.1), hang = dice.between(0.5, 1.1) * (1.2 - 0.5 * up) + 0.8 * withered;
        double twist = dice.between(-0.5, 0.5), swing = dice.between(-0.3, 0.3);
        Frame blade = stalk.at(1);
        blade = turned(blade, droop(blade, kink));
        Spine midrib(blade, leaf.length_m * (1 - kHeartFoot), 20, [&](double s, const Frame& frame) {
            return droop(frame, hang * (0.6 + 0.8 * s)) + frame.along * twist + frame.face * swing;
        });
        if (sunflower.has_leaf_cards)
            add_leaf_card(maker, midrib, leaf);
        else
            add_cut_leaf(maker, midrib, leaf);
    }
}

}  // namespace overlook::sample
