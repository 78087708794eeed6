#include "tools/make_sample/windmill.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "tools/make_sample/shapes.h"

namespace overlook::sample {
namespace {

enum : uint32_t { kWall, kRoof, kWood, kCloth };

// Of a level: sides and rings of the tower and of bars (no rings: a sail has no spar), cross bars of a sail, squares along and
// across its cloth.
struct Detail {
    uint32_t tower_sides, tower_rings, cap_rings, bar_sides, bar_rings, cross_bars, along, across;
};
constexpr std::array<Detail, kWindmillLevels> kDetails{
    {{64, 40, 16, 8, 24, 18, 24, 6}, {28, 14, 8, 6, 8, 9, 12, 3}, {12, 3, 3, 4, 2, 4, 3, 1}, {5, 1, 1, 3, 0, 0, 1, 1}}};

std::vector<mesh::Surface> surfaces() {
    std::vector<mesh::Surface> all(4);
    all[kWall].name = "wall", all[kWall].base_colour = {0.85f, 0.82f, 0.75f, 1};
    all[kRoof].name = "roof", all[kRoof].base_colour = {0.28f, 0.18f, 0.14f, 1};
    all[kWood].name = "wood", all[kWood].base_colour = {0.36f, 0.24f, 0.12f, 1};
    all[kCloth].name = "cloth", all[kCloth].base_colour = {0.90f, 0.88f, 0.80f, 1};
    return all;
}

mesh::Mesh tower(const Detail& detail) {
    ShapeMaker shapes(surfaces());
    shapes.add_tube(kWall, detail.tower_rings, detail.tower_sides, true, [](double up, double angle) {
        double radius_m = 3.4 - 1.3 * up - 0.25 * std::sin(std::numbers::pi * up);
        return glm::dvec3(radius_m * std::cos(angle), radius_m * std::sin(angle), 13 * up);
    });
    shapes.add_tube(kRoof, detail.cap_rings, detail.tower_sides, true, [](double up, double angle) {
        double radius_m = 2.4 * std::sqrt(std::max(0.0, 1 - 0.96 * up * up));
        return glm::dvec3(radius_m * std::cos(angle), radius_m * std::sin(angle), 12.9 + 3 * up);
    });
    shapes.add_bar(kWood, 1, std::max(3u, detail.bar_sides * 2), {0, -1, 13.9}, {0, -3.1, 13.9}, 0.3, 0.25);
    return shapes.take();
}

// About its axle at the origin, which points south.
mesh::Mesh sails(const Detail& detail) {
    ShapeMaker shapes(surfaces());
    for (int sail = 0; sail < 4; ++sail) {
        double angle = std::numbers::pi / 2 * sail + 0.3;
        glm::dvec3 out(std::cos(angle), 0, std::sin(angle)), across(-std::sin(angle), 0, std::cos(angle)), south(0, -1, 0);
        if (detail.bar_rings > 0) shapes.add_bar(kWood, detail.bar_rings, detail.bar_sides, 0.1 * out, 8.0 * out, 0.16, 0.09);
        glm::dvec3 tilted = glm::normalize(across + 0.25 * south);
        for (uint32_t i = 0; i < detail.cross_bars; ++i) {
            glm::dvec3 at_m = (1.6 + 6.2 * (i + 0.5) / detail.cross_bars) * out;
            shapes.add_bar(kWood, std::max(1u, detail.bar_rings / 4), std::max(3u, detail.bar_sides - 2), at_m - 0.1 * tilted,
                           at_m + 1.8 * tilted, 0.05, 0.04);
        }
        glm::dvec3 normal = glm::cross(out, tilted);
        shapes.add_box(kCloth, 4.7 * out + 0.85 * tilted + 0.08 * normal, 3.1 * out, 0.8 * tilted, 0.02 * normal, detail.along,
                       detail.across);
    }
    return shapes.take();
}

}  // namespace

std::vector<GlbNode> windmill(int level) {
    const Detail& detail = kDetails[size_t(std::clamp(level, 0, kWindmillLevels - 1))];
    return {{"tower", tower(detail), {0, 0, 0}, {0, 0, 0}}, {"sails", sails(detail), {0, -3.2, 13.9}, {0, -1, 0}}};
}

}  // namespace overlook::sample
