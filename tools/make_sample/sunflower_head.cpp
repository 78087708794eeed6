#include <algorithm>
#include <cmath>

#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_textures.h"
#include "tools/make_sample/sunflower.h"

namespace overlook::sample {
namespace {

constexpr uint32_t kFloretSides = 6, kFloretTriangles = 3 * kFloretSides;
constexpr uint32_t kHeadSides = 28, kBackRows = 8, kFloorRows = 5;

// The head's own measure: its axis, how wide and how domed the disc is, how far along its life.
struct Head {
    Frame frame;  // at the middle of the disc's rim plane; along is the axis
    double radius_m, dome, dip, opened, withered, age;

    glm::dvec3 outward(double angle) const { return std::cos(angle) * frame.side() - std::sin(angle) * frame.face; }
    // The disc's surface, r of its radius out.
    glm::dvec3 on_disc_m(double r, double angle) const {
        double up = dome * (1 - r * r) - dip * std::exp(-9 * r * r);
        return frame.at_m + radius_m * (r * outward(angle) + up * frame.along);
    }
    glm::dvec3 disc_normal(double r, double angle) const {
        double slope = -2 * dome * r + 18 * dip * r * std::exp(-9 * r * r);
        return glm::normalize(frame.along - slope * outward(angle));
    }
    double age_v(double up) const {
        double band = std::min(kDiscAges - 1.0, std::floor(age * kDiscAges * 0.999));
        return (band + 0.06 + 0.88 * up) / kDiscAges;
    }
};

Head head_of(const Sunflower& sunflower, const Frame& neck) {
    Head head{neck, sunflower.disc_radius_m, 0, 0, 0, 0, sunflower.age};
    head.opened = smooth_step(0, 0.26, sunflower.age), head.withered = smooth_step(0.68, 1, sunflower.age);
    head.dome = 0.16 + 0.22 * head.withered, head.dip = 0.1 * (1 - head.withered) * head.opened;
    head.frame.at_m += neck.along * (0.5 * head.radius_m);
    return head;
}

// From the stem's end round to the disc's rim, and under the florets: one closed skin.
void add_receptacle(PlantMaker& maker, const Head& head, double neck_radius_m) {
    constexpr double kRim = 1.04;
    auto at_m = [&](double radius, double up, double round) {
        return head.frame.at_m + head.radius_m * (radius * head.outward(kTurn_rad * round) + up * head.frame.along);
    };
    maker.add_round(kStem, kBackRows, kHeadSides, [&](uint32_t row, uint32_t side) {
        double share = double(row) / kBackRows, round = double(side) / kHeadSides;
        double radius = glm::mix(neck_radius_m / head.radius_m, kRim, std::sin(kTurn_rad / 4 * std::pow(share, 0.9)));
        glm::dvec2 uv(0.1 + 0.8 * (1 - std::abs(2 * round - 1)), 0.9 + 0.08 * share);
        return Place{row == kBackRows ? at_m(kRim, 0, round) : at_m(radius, -0.5 + 0.5 * std::pow(share, 2.6), round), uv};
    });
    auto floor = [&](double r, double round) {
        glm::dvec3 below_m = head.on_disc_m(r, kTurn_rad * round) - head.frame.along * (0.05 * head.radius_m);
        return Place{r == kRim ? at_m(kRim, 0, round) : below_m, {0.02 + 0.93 * r, head.age_v(0.1)}};
    };
    maker.add_round(
        kDisc, kFloorRows, kHeadSides,
        [&](uint32_t row, uint32_t side) {
            return floor(row == 0 ? kRim : 1 - (row - 0.5) / kFloorRows, double(side) / kHeadSides);
        },
        floor(0, 0));
}

// Each a bud, an open floret or a fruit that stands out of the disc.
void add_disc_florets(PlantMaker& maker, const Head& head, uint32_t count, Dice& dice) {
    double spacing_m = head.radius_m / std::sqrt(double(count));
    double ring = 0.98 - 1.05 * smooth_step(0.05, 0.8, head.age);
    for (uint32_t n = 0; n < count; ++n) {
        double r = std::sqrt((n + 0.5) / count), angle = kGoldenAngle_rad * n;
        double blows = std::max(0.0, 1 - std::abs(r - ring) / 0.14) * (1 - head.withered);
        double rough = dice.between(-1, 1), lean = 0.25 * r;
        glm::dvec3 foot_m = head.on_disc_m(r, angle), normal = head.disc_normal(r, angle);
        glm::dvec3 up = glm::normalize(normal + lean * head.outward(angle) + 0.12 * rough * head.outward(angle + 1.5708));
        glm::dvec3 first = head.outward(angle), across = glm::cross(up, first);
        double tall_m = spacing_m * (0.75 + 0.5 * r + 1.3 * blows + 0.12 * rough + 0.25 * head.withered);
        double wide_m = 0.84 * spacing_m, flare = 0.62 + 0.3 * blows + 0.12 * head.withered;
        double u = std::clamp(0.02 + 0.96 * (r + 0.015 * rough), 0.0, 1.0);
        auto place = [&](uint32_t row, uint32_t side) {
            double round = kTurn_rad * side / kFloretSides, radius_m = row == 0 ? wide_m : wide_m * flare;
            glm::dvec3 out = std::cos(round) * first + std::sin(round) * across;
            return Place{foot_m + out * radius_m + up * (row == 0 ? -0.05 * head.radius_m : 0.72 * tall_m),
                         {u, head.age_v(row == 0 ? 0.0 : 0.7)}};
        };
        maker.add_round(kDisc, 1, kFloretSides, place, {foot_m + up * (tall_m * (1 - 0.35 * blows)), {u, head.age_v(1)}});
    }
}

// What a row of petals or bracts has in common.
struct Whorl {
    double radius, up;          // where they stand, of the disc's radius
    double length, half_width;  // of the disc's radius
    double rise_rad;            // from the disc's plane
    double curl_rad;            // over their length, towards the axis
    double unrest_rad;
};

Spine spine_of(const Head& head, const Whorl& whorl, double angle, double length, Dice& dice) {
    double rise = whorl.rise_rad + whorl.unrest_rad * dice.between(-1, 1),
           curl = whorl.curl_rad + 2 * whorl.unrest_rad * dice.between(-1, 1);
    double roll = 1.2 * whorl.unrest_rad * dice.between(-1, 1), swing = whorl.unrest_rad * dice.between(-1, 1);
    double twist = 2.2 * whorl.unrest_rad * dice.between(-1, 1);
    glm::dvec3 out = head.outward(angle), axis = head.frame.along;
    glm::dvec3 at_m = head.frame.at_m + head.radius_m * (whorl.radius * out + whorl.up * axis);
    Frame foot = frame_of(at_m, std::cos(rise) * out + std::sin(rise) * axis, std::cos(rise) * axis - std::sin(rise) * out);
    foot = turned(foot, foot.along * roll);
    return Spine(foot, length * head.radius_m, 16, [=](double share, const Frame& frame) {
        return frame.side() * (curl * (0.4 + 1.2 * share)) + frame.face * swing + frame.along * twist;
    });
}

void add_rays(PlantMaker& maker, const Head& head, uint32_t first_number, Dice& dice) {
    uint32_t count = 34 + dice.below(8);
    for (uint32_t i = 0; i < count; ++i) {
        double outer = double(i) / count, length = dice.between(0.98, 1.28) * (1 - 0.12 * outer);
        double falls = dice.unit();
        if (falls < 0.45 * head.withered) continue;
        Whorl whorl{1.0, -0.02 - 0.08 * outer, length * (0.62 + 0.38 * head.opened) * (1 - 0.3 * head.withered), 0.19, 0, 0, 0};
        whorl.rise_rad = glm::mix(1.25, 0.28 - 0.42 * outer, head.opened) - 0.5 * head.withered;
        whorl.curl_rad = glm::mix(0.9, -0.35, head.opened) + 0.9 * head.withered * (falls > 0.7 ? 1.4 : -1);
        whorl.unrest_rad = 0.13 + 0.4 * head.withered;
        Spine spine =
            spine_of(head, whorl, kGoldenAngle_rad * (first_number + i) + dice.between(-0.05, 0.05), whorl.length, dice);
        double wide =
            whorl.half_width * head.radius_m * dice.between(0.85, 1.12) * (1 - 0.45 * head.withered) * (0.6 + 0.4 * head.opened);
        double keel = dice.between(0.1, 0.35) + 0.5 * head.withered;
        uint32_t strip = head.opened < 0.6 ? 6 : dice.below(6);
        if (dice.unit() < head.withered) strip = 7;
        Blade blade{10, 6, {}, {}, {(strip + 0.06) / kRayStrips, 0.01}, {(strip + 0.94) / kRayStrips, 0.99}};
        blade.half_width_m = [=](double s) {
            double body = std::pow(std::sin(3.1416 * std::pow(0.04 + 0.955 * s, 0.8)), 0.7);
            return wide * std::max(0.03, body * (0.75 + 0.25 * smooth_step(0, 0.3, s)));
        };
        // Raised at the sides and pleated twice along.
        blade.lift_m = [=](double a, double s) {
            return wide * (keel * a * a - 0.09 * std::cos(9.4 * a)) * std::min(1.0, 4 * s);
        };
        maker.add_blade(kRays, spine, blade);
    }
}

void add_bracts(PlantMaker& maker, const Head& head, Dice& dice) {
    uint32_t count = 28 + dice.below(6);
    for (uint32_t i = 0; i < count; ++i) {
        double outer = double(i) / count;
        Whorl whorl{0.97 - 0.12 * outer, -0.06 - 0.16 * outer, dice.between(0.72, 0.95), 0.15, 0, 0, 0.14};
        whorl.rise_rad = glm::mix(1.1, -0.15 - 0.5 * outer, head.opened),
        whorl.curl_rad = glm::mix(0.5, -0.5 * outer - 0.1, head.opened) + 0.5 * head.withered;
        Spine spine = spine_of(head, whorl, kGoldenAngle_rad * i + dice.between(-0.1, 0.1), whorl.length, dice);
        double wide = whorl.half_width * head.radius_m * dice.between(0.85, 1.15);
        // Their picture is a part of a leaf beside its midrib.
        double u = (head.withered > 0.4 ? 0.5 : 0) + dice.between(0.27, 0.32), v = dice.between(0.3, 0.36);
        Blade blade{6, 4, {}, {}, {u, v}, {u + 0.06, v + 0.25}};
        blade.half_width_m = [=](double s) { return wide * std::max(0.02, std::pow(1 - s, 0.8) * (1.0 + 1.2 * s)); };
        blade.lift_m = [=](double a, double) { return 0.25 * wide * a * a; };
        maker.add_blade(kHeartLeaves, spine, blade);
    }
}

}  // namespace

void add_head(PlantMaker& maker, const Sunflower& sunflower, const Frame& neck, double neck_radius_m, Dice& dice) {
    Head head = head_of(sunflower, neck);
    add_receptacle(maker, head, neck_radius_m);
    add_bracts(maker, head, dice);
    Dice florets(uint64_t(dice.unit() * 0x1p53));
    add_rays(maker, head, dice.below(1000), dice);
    size_t left = kSunflowerTriangles - std::min(kSunflowerTriangles, maker.triangle_count());
    add_disc_florets(maker, head, std::max(400u, uint32_t(left / kFloretTriangles)), florets);
}

}  // namespace overlook::sample
