#include "tools/bake/relief_colour.h"

#include <algorithm>
#include <cmath>

#include "formats/srgb.h"

namespace overlook::relief {
namespace {

Colour blend(const Colour& a, const Colour& b, double share) {
    return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

double ramp(double from, double to, double x) {
    double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// Linear light from 8-bit sRGB values; element i is the linear value half way between i and i + 1.
std::array<double, 255> make_thresholds() {
    std::array<double, 255> thresholds{};
    for (size_t i = 0; i < thresholds.size(); ++i) thresholds[i] = overlook::linear_from_srgb((double(i) + 0.5) / 255);
    return thresholds;
}

// A level surface found from one of its cells.
struct Surface {
    std::vector<uint32_t> cells;
    uint64_t rim = 0, lower = 0,
             beyond = 0;  // sides of cells that end it; of these, towards lower ground; off the grid or void
};

Surface trace_surface(const Field& field, uint32_t start, std::vector<uint8_t>& is_seen) {
    Surface surface;
    surface.cells.push_back(start);
    is_seen[start] = 1;
    float level = field.height_m[start];
    for (size_t n = 0; n < surface.cells.size(); ++n) {
        uint32_t cell = surface.cells[n], column = cell % field.width, row = cell / field.width;
        auto look = [&](bool is_inside, uint32_t next) {
            float there = is_inside ? field.height_m[next] : NAN;
            if (there == level) {
                if (is_seen[next] == 0) surface.cells.push_back(next);
                is_seen[next] = 1;
                return;
            }
            ++surface.rim;
            surface.lower += there < level;
            surface.beyond += std::isnan(there);
        };
        look(column > 0, cell - 1);
        look(column + 1 < field.width, cell + 1);
        look(row > 0, cell - field.width);
        look(row + 1 < field.height, cell + field.width);
    }
    return surface;
}

}  // namespace

Colour linear_from_srgb(uint8_t red, uint8_t green, uint8_t blue) {
    return {linear_from_srgb_code(red), linear_from_srgb_code(green), linear_from_srgb_code(blue)};
}

uint8_t srgb_from_linear(double linear) {
    static const std::array<double, 255> thresholds = make_thresholds();
    return uint8_t(std::upper_bound(thresholds.begin(), thresholds.end(), linear) - thresholds.begin());
}

Colour ground_colour(const Ground& g) {
    static const Colour plain = linear_from_srgb(146, 148, 98), meadow = linear_from_srgb(112, 128, 76);
    static const Colour forest = linear_from_srgb(64, 86, 56), alp = linear_from_srgb(130, 132, 90);
    static const Colour scree = linear_from_srgb(148, 142, 124), rock = linear_from_srgb(112, 107, 98);
    static const Colour snow = linear_from_srgb(240, 243, 248), water = linear_from_srgb(38, 84, 104);
    if (g.is_water) return water;

    // Height carries the plants up, hollows a little farther than crests.
    double mountains = ramp(250, 1400, g.relief_m);
    double h = g.height - 0.05 * g.hollow - 0.05 * g.valley;
    Colour colour = blend(plain, meadow, ramp(0.02, 0.16, h));
    double wooded = ramp(0.08, 0.20, h) * (1 - ramp(0.42, 0.56, h)) * ramp(0.10, 0.32, g.slope + 0.12 * g.hollow);
    colour = blend(colour, alp, ramp(0.34, 0.58, h));
    colour = blend(colour, forest, 0.9 * wooded);
    colour = blend(colour, scree, ramp(0.55, 0.78, h));

    // Steep ground is bare, the sooner the higher.
    double bare_from = 0.85 - 0.40 * ramp(0.15, 0.75, h);
    colour = blend(colour, rock, ramp(bare_from, bare_from + 0.45, g.slope - 0.15 * g.hollow));
    double white = ramp(0.60, 0.80, h + 0.06 * g.hollow) * (1 - ramp(0.75, 1.25, g.slope - 0.25 * g.hollow));
    colour = blend(colour, snow, mountains * white);

    // Hollows are moister, crests paler.
    double tone = 1 - 0.16 * g.hollow - 0.06 * g.valley;
    return {colour[0] * tone, colour[1] * (tone + 0.02 * g.hollow), colour[2] * tone};
}

std::vector<uint8_t> find_water(const Field& field, uint32_t least_cells) {
    std::vector<uint8_t> is_seen(field.height_m.size()), is_water(field.height_m.size());
    for (uint32_t cell = 0; cell < field.height_m.size(); ++cell) {
        if (is_seen[cell] != 0 || std::isnan(field.height_m[cell])) continue;
        Surface surface = trace_surface(field, cell, is_seen);
        bool is_lake = surface.cells.size() >= least_cells && surface.cells.size() >= 5 * surface.rim &&
                       surface.lower * 100 <= surface.rim * 3 && surface.beyond * 4 <= surface.rim;
        if (!is_lake) continue;
        for (uint32_t wet : surface.cells) is_water[wet] = 1;
    }
    return is_water;
}

}  // namespace overlook::relief
