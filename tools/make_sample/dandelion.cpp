#include <algorithm>
#include <cmath>

#include "tools/make_sample/meadow.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/plant_shapes.h"
#include "tools/make_sample/plant_textures.h"

namespace overlook::sample {
namespace {

enum : uint32_t { kLeaves, kStalks, kLigules, kParachutes };

// A leaf whose lobes point back to its foot.
void add_leaf(PlantMaker& maker, double angle, Dice& dice) {
    constexpr uint32_t kTeeth = 6, kRows = 2 * kTeeth + 2, kColumns = 4;
    double length_m = dice.between(0.10, 0.18), rise = dice.between(0.25, 0.85),
           wide_m = 0.13 * length_m * dice.between(0.85, 1.2);
    double bend = dice.between(0.5, 1.1), twist = dice.between(-0.5, 0.5), depth = dice.between(0.45, 0.7);
    glm::dvec3 out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    Frame foot = frame_of(0.006 * out - 0.004 * up, std::cos(rise) * out + std::sin(rise) * up,
                          std::cos(rise) * up - std::sin(rise) * out);
    // It sinks until it lies on the ground.
    Spine midrib(foot, length_m, 24, [&](double s, const Frame& frame) {
        double high_m = frame.at_m.z - 0.006;
        double turns = std::max(bend * 2.2 * s, 0.0) * smooth_step(0, 0.02, high_m + 0.02 * frame.along.z);
        double lifts = frame.along.z < 0 ? 3.0 * (1 - smooth_step(0, 0.02, high_m)) : 0;
        return droop(frame, turns - lifts) + frame.along * twist * s;
    });
    double phase = dice.between(0, kTurn_rad);
    maker.add_sheet(kLeaves, kRows, kColumns, [&](uint32_t row, uint32_t column) {
        double share = double(row) / kRows, across = 2.0 * column / kColumns - 1, a = std::abs(across);
        double body = std::sin(3.05 * (0.06 + 0.94 * std::pow(share, 1.5))) * (0.35 + 0.65 * smooth_step(0.05, 0.5, share));
        bool is_lobe = row % 2 == 1 && row < kRows - 1;
        double reach = std::max(0.05, body * (is_lobe ? 1.15 : 1 - depth * (1 - 0.6 * share)));
        double back = is_lobe && a > 0.9 ? 0.45 / kRows : 0;
        Frame frame = midrib.at(std::max(0.0, share - back));
        double lift = 0.3 * a * reach + 0.12 * std::sin(3.0 * row + phase + 2 * across) * a;
        return Place{frame.at_m + frame.side() * (across * reach * wide_m) + frame.face * (lift * wide_m),
                     {0.5 + 0.42 * across * reach, 0.02 + 0.96 * share}};
    });
}

Spine stalk_of(double angle, double length_m, Dice& dice) {
    glm::dvec3 out(std::cos(angle), std::sin(angle), 0), up(0, 0, 1);
    double lean = dice.between(0.1, 0.4), back = dice.between(0.0, 0.5), swing = dice.between(-0.4, 0.4);
    Frame foot = frame_of(0.004 * out - 0.006 * up, std::sin(lean) * out + std::cos(lean) * up, out);
    return Spine(foot, length_m, 20, [&](double s, const Frame& frame) {
        return droop(frame, -back * 1.6 * s) + swing * glm::dvec3(out.x, out.y, 0) * std::sin(4 * s);
    });
}

glm::dvec3 outward(const Frame& frame, double angle) {
    return std::cos(angle) * frame.side() - std::sin(angle) * frame.face;
}

// Green scales about the foot of a head; opened: 0 they close about it, 1 they hang.
void add_scales(PlantMaker& maker, const Frame& head, double radius_m, double opened, Dice& dice) {
    for (uint32_t i = 0; i < 16; ++i) {
        double angle = kGoldenAngle_rad * i, rise = 1.35 - (i < 8 ? 0.5 : 2.6) * opened + dice.between(-0.15, 0.15);
        glm::dvec3 out = outward(head, angle), foot_m = head.at_m + radius_m * (0.42 * out - 0.35 * head.along);
        Frame foot = frame_of(foot_m, std::cos(rise) * out + std::sin(rise) * head.along,
                              std::cos(rise) * head.along - std::sin(rise) * out);
        double length_m = radius_m * dice.between(0.8, 1.1), wide_m = 0.13 * radius_m;
        Spine spine(foot, length_m, 6, [&](double, const Frame& frame) { return frame.side() * (0.6 - 1.2 * opened); });
        maker.add_blade(kLeaves, spine,
                        {3, 2, [=](double s) { return wide_m * std::max(0.06, 1 - s); }, {}, {0.62, 0.4}, {0.72, 0.6}});
    }
}

void add_cup(PlantMaker& maker, const Frame& head, double radius_m) {
    constexpr uint32_t kRows = 4, kSides = 9;
    maker.add_round(kStalks, kRows, kSides, [&](uint32_t row, uint32_t side) {
        double share = double(row) / kRows, round = double(side) / kSides;
        double wide = radius_m * (0.1 + 0.42 * std::sin(1.5 * share)), up = radius_m * (0.75 * share - 0.75);
        return Place{head.at_m + wide * outward(head, kTurn_rad * round) + up * head.along, {1 - std::abs(2 * round - 1), 0.9}};
    });
}

// Ligules by golden angles, the inner ones shorter and steeper.
void add_flower(PlantMaker& maker, const Frame& head, double radius_m, double opened, Dice& dice) {
    add_cup(maker, head, radius_m), add_scales(maker, head, radius_m, 0.75 * opened, dice);
    constexpr uint32_t kCount = 110;
    for (uint32_t n = 0; n < kCount; ++n) {
        double r = std::sqrt((n + 0.5) / kCount), angle = kGoldenAngle_rad * n + dice.between(-0.1, 0.1);
        double rise = glm::mix(1.5 - 0.1 * r, 1.45 - 1.25 * r * r, opened) + dice.between(-0.12, 0.12);
        double length_m = radius_m * (0.42 + 0.58 * r) * dice.between(0.85, 1.1) * (0.7 + 0.3 * opened);
        glm::dvec3 out = outward(head, angle);
        glm::dvec3 foot_m = head.at_m + radius_m * (0.36 * r * out + (0.1 * (1 - r * r) - 0.12) * head.along);
        Frame foot = frame_of(foot_m, std::cos(rise) * out + std::sin(rise) * head.along,
                              std::cos(rise) * head.along - std::sin(rise) * out);
        double curl = dice.between(-0.5, 0.2) * opened, wide_m = 0.075 * radius_m * dice.between(0.85, 1.15);
        Spine spine(foot, length_m, 6, [&](double s, const Frame& frame) { return frame.side() * (2 * curl * s); });
        maker.add_blade(kLigules, spine,
                        {3,
                         1,
                         [=](double s) { return wide_m * (0.5 + 0.6 * std::min(1.0, 2 * s)) * (s > 0.9 ? 0.75 : 1.0); },
                         {},
                         {0.05, 0.02},
                         {0.95, 0.98}});
    }
}

// Fruits about a ball, each with its beak and its parachute.
void add_globe(PlantMaker& maker, const Frame& head, double radius_m, Dice& dice) {
    add_scales(maker, head, 0.5 * radius_m, 1, dice);
    maker.add_round(kStalks, 3, 8,
                    [&](uint32_t row, uint32_t side) {
                        double polar = 2.7 - 0.85 * row, round = double(side) / 8, wide = 0.2 * radius_m * std::sin(polar);
                        return Place{
                            head.at_m + wide * outward(head, kTurn_rad * round) + head.along * (0.2 * radius_m * std::cos(polar)),
                            {1 - std::abs(2 * round - 1), 0.95}};
                    },
                    {head.at_m + head.along * (0.2 * radius_m), {0.5, 0.95}});
    constexpr uint32_t kCount = 120;
    double missing = dice.unit() < 0.4 ? dice.between(0.1, 0.35) : 0;
    glm::dvec3 blown = outward(head, dice.between(0, kTurn_rad));
    for (uint32_t n = 0; n < kCount; ++n) {
        double up = 1 - 1.8 * (n + 0.5) / kCount, flat = std::sqrt(1 - up * up);
        glm::dvec3 out = up * head.along + flat * outward(head, kGoldenAngle_rad * n),
                   tangent = glm::normalize(glm::cross(out, std::abs(up) > 0.9 ? head.face : head.along));
        double reach = dice.between(0.74, 0.84), spin = dice.between(0, kTurn_rad);
        if (glm::dot(out, blown) > 1 - 2 * missing) continue;
        glm::dvec3 across = glm::cross(out, tangent), right = std::cos(spin) * tangent + std::sin(spin) * across,
                   above = glm::cross(out, right);
        auto strip = [&](uint32_t surface, double from, double to, double half_m, double v) {
            maker.add_sheet(surface, 1, 1, [&](uint32_t row, uint32_t column) {
                return Place{head.at_m + out * (radius_m * (row == 0 ? from : to)) + right * (half_m * (2.0 * column - 1)),
                             {0.2 + 0.6 * column, v + 0.05 * row}};
            });
        };
        strip(kStalks, 0.19, 0.36, 0.0009, 0.02), strip(kStalks, 0.36, reach, 0.00025, 0.9);
        double half_m = 0.36 * radius_m;
        maker.add_sheet(kParachutes, 2, 2, [&](uint32_t row, uint32_t column) {
            double x = double(column) - 1, y = double(row) - 1, bowl = 0.16 * radius_m * (x * x + y * y);
            return Place{head.at_m + out * (radius_m * reach + bowl) + half_m * (x * right + y * above),
                         {0.5 + 0.5 * x, 0.5 + 0.5 * y}};
        });
    }
}

}  // namespace

Result<std::vector<mesh::Surface>> dandelion_surfaces(uint64_t seed) {
    Result<mesh::Surface> made[] = {
        painted("dandelion-leaf", Skin::two_sided, 64, 128, toothed_leaf_paint(seed + 1)),
        painted("dandelion-stalk", Skin::closed, 16, 64, stalk_paint(seed + 2, {0.50, 0.36, 0.28}, {0.50, 0.58, 0.32})),
        painted("ligule", Skin::two_sided, 16, 64, ligule_paint(seed + 3)),
        painted("parachute", Skin::masked, 64, 64, parachute_paint(seed + 4))};
    std::vector<mesh::Surface> surfaces;
    for (Result<mesh::Surface>& surface : made) {
        if (!surface) return tl::unexpected(surface.error());
        surfaces.push_back(std::move(*surface));
    }
    surfaces[kStalks].is_two_sided = true;  // beaks are strips
    return surfaces;
}

mesh::Mesh dandelion_mesh(uint64_t seed, int number, const std::vector<mesh::Surface>& surfaces) {
    Dice dice(hash_of(seed, 300, uint64_t(number)));
    PlantMaker maker(surfaces);
    uint32_t leaves = 8 + dice.below(5);
    for (uint32_t i = 0; i < leaves; ++i) add_leaf(maker, kGoldenAngle_rad * i + dice.between(-0.3, 0.3), dice);
    bool has_globe = number % 3 == 2;
    uint32_t heads = 1 + dice.below(2);
    double turn = dice.between(0, kTurn_rad);
    for (uint32_t i = 0; i < heads; ++i) {
        turn += dice.between(1.5, 3.5);
        bool is_globe = has_globe && i == 0;
        double length_m = is_globe ? dice.between(0.2, 0.3) : dice.between(0.09, 0.22), thick_m = dice.between(0.0017, 0.0024);
        double opened = number % 4 == 3 && i > 0 ? dice.between(0, 0.35) : dice.between(0.75, 1);
        double radius_m = is_globe ? dice.between(0.020, 0.025) : dice.between(0.017, 0.023);
        Spine stalk = stalk_of(turn, length_m, dice);
        maker.add_stalk(kStalks, stalk,
                        {10, 6, [=](double s) { return thick_m * (1.2 - 0.3 * s); }, {0.05, 0.02}, {0.95, 0.98}, false});
        Frame head = stalk.at(1);
        head.at_m += head.along * (is_globe ? 0.15 * radius_m : 0.7 * radius_m);
        if (is_globe)
            add_globe(maker, head, radius_m, dice);
        else
            add_flower(maker, head, radius_m, opened, dice);
    }
    return maker.take();
}

}  // namespace overlook::sample
