#include <algorithm>
#include <cmath>

#include "tools/make_sample/meadow.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_shapes.h"
#include "tools/make_sample/plant_textures.h"

namespace overlook::sample {
namespace {

constexpr uint32_t kStraw = 6, kChaff = 7;

// A strip of the picture.
void set_strip(Blade& blade, uint32_t strip, double v_from, double v_to) {
    blade.uv_from = {(strip + 0.1) / kBladeStrips, v_from}, blade.uv_to = {(strip + 0.9) / kBladeStrips, v_to};
}

struct Tuft {
    double height_m, spread_m, lean_rad, dry;
    double reach_m;  // no leaf goes farther out
};

Frame foot_in(const Tuft& tuft, double out_share, double angle, double lean_rad) {
    glm::dvec3 out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    return frame_of(tuft.spread_m * out_share * out - 0.015 * up, std::sin(lean_rad) * out + std::cos(lean_rad) * up,
                    std::cos(lean_rad) * -out + std::sin(lean_rad) * up);
}

double lowest_m(const Spine& spine) {
    double least_m = spine.at(0).at_m.z;
    for (int i = 1; i <= 16; ++i) least_m = std::min(least_m, spine.at(i / 16.0).at_m.z);
    return least_m;
}

// From the axis through the tuft's foot.
double farthest_m(const Spine& spine) {
    double most_m = 0;
    for (int i = 0; i <= 16; ++i) {
        glm::dvec3 at_m = spine.at(i / 16.0).at_m;
        most_m = std::max(most_m, std::hypot(at_m.x, at_m.y));
    }
    return most_m;
}

void add_leaf(PlantMaker& maker, const Tuft& tuft, uint32_t i, uint32_t count, Dice& dice) {
    double out = std::sqrt((i + 0.5) / count), angle = kGoldenAngle_rad * i + dice.between(-0.4, 0.4);
    double lean = tuft.lean_rad * (0.25 + 0.75 * out) * dice.between(0.6, 1.3);
    double length_m = tuft.height_m * dice.between(0.6, 1.12) * (1.1 - 0.25 * out);
    Frame foot = foot_in(tuft, out, angle, lean);
    foot = turned(foot, foot.along * dice.between(-0.9, 0.9));
    double bend = dice.between(0.6, 2.0), twist = dice.between(-1.2, 1.2), swing = dice.between(-0.3, 0.3);
    double breaks_at = dice.between(0.45, 0.8), break_rad = dice.unit() < 0.18 ? dice.between(0.7, 1.6) : 0;
    auto turn = [&](double s, const Frame& frame) {
        double kink = std::abs(s - breaks_at) < 0.04 ? break_rad / 0.08 : 0;
        // What comes down to the ground goes on along it.
        double lifts = frame.along.z < 0 ? 12 * (1 - smooth_step(0, 0.05, frame.at_m.z)) : 0;
        return droop(frame, bend * 2 * s + kink - lifts) + frame.along * twist + frame.face * swing;
    };
    Spine spine(foot, length_m, 16, turn);
    while (lowest_m(spine) < foot.at_m.z) bend *= 0.7, break_rad *= 0.5, spine = Spine(foot, length_m, 16, turn);
    double most_m = farthest_m(spine);
    if (most_m > tuft.reach_m) spine = Spine(foot, length_m * tuft.reach_m / most_m, 16, turn);
    double wide_m = dice.between(0.0024, 0.0044) * (0.7 + tuft.height_m);
    uint32_t strip = dice.unit() < tuft.dry ? 5 + dice.below(2) : dice.below(5);
    // Every third one is keeled.
    Blade blade{5, i % 3 == 0 ? 2u : 1u, {}, {}, {}, {}};
    set_strip(blade, strip, 0.01, 0.99);
    blade.half_width_m = [=](double s) { return wide_m * std::max(0.06, (0.75 + 0.5 * s) * std::pow(1 - s, 0.55)); };
    blade.lift_m = [=](double a, double s) { return 0.55 * wide_m * std::abs(a) * (1 - s); };
    maker.add_blade(0, spine, blade);
}

// A culm with a loose panicle or a dense spike at its end.
void add_culm(PlantMaker& maker, const Tuft& tuft, bool is_spike, Dice& dice) {
    double angle = dice.between(0, kTurn_rad), lean = 0.5 * tuft.lean_rad * dice.between(0.3, 1.2), bend = dice.between(0.2, 0.8);
    double length_m = tuft.height_m * dice.between(1.15, 1.5), thick_m = dice.between(0.0008, 0.0013);
    auto grown = [&] {
        return Spine(foot_in(tuft, 0.4, angle, lean), length_m, 20,
                     [&](double s, const Frame& frame) { return droop(frame, 2 * bend * s); });
    };
    Spine culm = grown();
    while (farthest_m(culm) > 1.1 * tuft.reach_m) lean *= 0.7, bend *= 0.7, culm = grown();
    uint32_t strip = dice.unit() < 0.5 ? kStraw : 4;
    Stalk stalk{9,
                3,
                [=](double s) { return thick_m * (1.1 - 0.7 * s); },
                {(strip + 0.2) / kBladeStrips, 0.3},
                {(strip + 0.8) / kBladeStrips, 0.95},
                false};
    maker.add_stalk(0, culm, stalk);
    uint32_t count = is_spike ? 44 : 26;
    double ear = is_spike ? 0.2 : 0.34, turn = dice.between(0, kTurn_rad);
    for (uint32_t i = 0; i < count; ++i) {
        double share = 1 - ear * (1 - (i + 0.5) / count), near = 1 - (i + 0.5) / count;
        Frame on = culm.at(share);
        turn += kGoldenAngle_rad;
        double off = is_spike ? 0.35 : dice.between(0.5, 1.0);
        glm::dvec3 out = std::cos(turn) * on.side() + std::sin(turn) * on.face;
        double reach_m = is_spike ? 0.0 : length_m * ear * 0.42 * near * dice.between(0.4, 1.0);
        glm::dvec3 along = glm::normalize(std::cos(off) * on.along + std::sin(off) * out);
        Frame foot = frame_of(on.at_m + along * reach_m, along, out);
        double grain_m = (is_spike ? 0.011 : 0.0095) * dice.between(0.8, 1.25), wide_m = 0.21 * grain_m;
        Spine grain(foot, grain_m, 3, [&](double, const Frame& frame) { return droop(frame, 0.4); });
        Blade blade{3, 1, [=](double s) { return wide_m * std::max(0.08, std::sin(3.0 * (0.1 + 0.9 * s))); }, {}, {}, {}};
        set_strip(blade, kChaff, 0.05, 0.95);
        maker.add_blade(0, grain, blade);
        if (is_spike || reach_m < 0.004) continue;
        Spine twig(frame_of(on.at_m, along, out), reach_m, 2, [](double, const Frame&) { return glm::dvec3(0); });
        Blade thread{1, 1, [=](double) { return 0.0004; }, {}, {}, {}};
        set_strip(thread, kStraw, 0.3, 0.9);
        maker.add_blade(0, twig, thread);
    }
}

}  // namespace

Result<std::vector<mesh::Surface>> grass_surfaces(uint64_t seed) {
    auto blades = painted("blades", Skin::two_sided, 256, 128, blade_paint(seed));
    if (!blades) return tl::unexpected(blades.error());
    return std::vector<mesh::Surface>{std::move(*blades)};
}

mesh::Mesh grass_mesh(uint64_t seed, int number, const std::vector<mesh::Surface>& surfaces) {
    Dice dice(hash_of(seed, 200, uint64_t(number)));
    PlantMaker maker(surfaces);
    double place = (number * 4 % kGrasses + dice.unit()) / kGrasses;
    Tuft tuft{0.15 + 0.27 * place, dice.between(0.03, 0.055), dice.between(0.45, 0.9), 0, 0.09 + 0.08 * place};
    tuft.dry = dice.between(0.03, 0.25);
    uint32_t count = 44 + dice.below(19);
    for (uint32_t i = 0; i < count; ++i) add_leaf(maker, tuft, i, count, dice);
    if (number % 3 == 0) {
        uint32_t culms = 1 + dice.below(2);
        bool is_spike = dice.unit() < 0.5;
        for (uint32_t i = 0; i < culms; ++i) add_culm(maker, tuft, is_spike, dice);
    }
    return maker.take();
}

}  // namespace overlook::sample
