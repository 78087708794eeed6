#include "tools/make_sample/canyon_ground.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/parallel.h"
#include "tools/bake/relief_colour.h"
#include "tools/bake/relief_light.h"
#include "tools/make_sample/drainage.h"
#include "tools/make_sample/erosion.h"
#include "tools/make_sample/noise.h"
#include "tools/make_sample/sample_terrains.h"
#include "tools/make_sample/terrain_surfaces.h"

namespace overlook::sample {
namespace {

constexpr uint32_t kSide = kCanyon.columns;
constexpr double kCell_m = kCanyon.width_m / (kSide - 1);
constexpr double kMouth_m = 480;  // where the river leaves, in the west
constexpr double kLedge_m = 230;  // from one band of hard rock to the next

// How far south the river runs, 0..1 of the square.
double river_south(uint64_t seed, double east) {
    return 0.5 + 0.15 * gradient_noise(seed + 1, east * 3.1 + 0.4, 0.7) + 0.05 * gradient_noise(seed + 2, east * 9.3, 0.3);
}

double plateau_m(uint64_t seed, double east, double south) {
    double dome = smooth_step(-0.35, 0.5, fractal_noise(seed + 3, east * 2.3, south * 2.3, 2));
    // The slopes towards the river bend, so that brooks do not run side by side.
    double bent = south + 0.11 * fractal_noise(seed + 8, east * 5, south * 5, 3);
    double off_km = std::abs(bent - river_south(seed, east)) * kCanyon.width_m / 1000;
    double rough = 80 * fractal_noise(seed + 4, east * 11, south * 11, 5), rim = 260 * (1 - smooth_step(0, 0.10, east));
    return 1350 + 520 * dome + 5 * off_km + 120 * east + rim + rough;
}

// Steep where rock is hard, level where it is soft, in the canyon alone.
void cut_ledges(Grid& height_m, std::span<const double> plateau) {
    std::vector<double> around = box_mean(height_m.values, height_m.side, height_m.side, 14);
    for (size_t i = 0; i < height_m.values.size(); ++i) {
        double z_m = height_m.values[i], step = z_m / kLedge_m, base = std::floor(step);
        double ledge_m = kLedge_m * (base + smooth_step(0.28, 0.72, step - base));
        double depth_m = std::max(plateau[i] - z_m, around[i] - z_m);
        height_m.values[i] += 0.85 * smooth_step(60, 320, depth_m) * (ledge_m - z_m);
    }
}

using relief::Colour;

Colour blend(const Colour& a, const Colour& b, double share) {
    double t = std::clamp(share, 0.0, 1.0);
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

// Bands by height, from the river up.
Colour band_colour(double z_m) {
    static const std::array<Colour, 7> kBands = {relief::linear_from_srgb(92, 74, 64),    relief::linear_from_srgb(134, 96, 74),
                                                 relief::linear_from_srgb(158, 92, 62),   relief::linear_from_srgb(176, 112, 74),
                                                 relief::linear_from_srgb(196, 146, 100), relief::linear_from_srgb(170, 104, 70),
                                                 relief::linear_from_srgb(206, 172, 128)};
    double at = std::clamp((z_m - 450) / kLedge_m, 0.0, 5.999);
    uint32_t band = uint32_t(at);
    return blend(kBands[band], kBands[band + 1], smooth_step(0.3, 0.7, at - band));
}

Colour ground_colour(const CanyonGround& ground, uint64_t seed, double east, double south, double slope) {
    double z_m = ground.height_m(east, south), x = east * 245, y = south * 122;
    Colour colour = band_colour(z_m + 40 * fractal_noise(seed + 40, x / 6, y / 6, 3));
    Colour grass = blend(relief::linear_from_srgb(156, 138, 88), relief::linear_from_srgb(186, 148, 96),
                         0.5 + fractal_noise(seed + 41, x / 9, y / 9, 4));
    double flat = 1 - smooth_step(0.10, 0.24, slope);
    colour = blend(colour, grass, 0.75 * flat * smooth_step(1300, 1600, z_m));
    double wooded = smooth_step(1750, 2050, z_m + 160 * fractal_noise(seed + 42, x / 8, y / 8, 5));
    colour = blend(colour, relief::linear_from_srgb(58, 74, 44), 0.85 * wooded * (1 - 0.6 * smooth_step(0.2, 0.5, slope)));
    double tone = 1 + 0.16 * fractal_noise(seed + 43, x / 1.2, y / 1.2, 3);
    for (double& channel : colour) channel *= tone;
    double column = east * (ground.side - 1), row = (0.25 + 0.5 * south) * (ground.side - 1);
    return blend(colour, relief::linear_from_srgb(58, 84, 88),
                 smooth_step(0.45, 0.75, between(ground.river, ground.side, ground.side, column, row)));
}

}  // namespace

double between(std::span<const double> values, uint32_t columns, uint32_t rows, double x, double y) {
    x = std::clamp(x, 0.0, double(columns - 1));
    y = std::clamp(y, 0.0, double(rows - 1));
    uint32_t i = std::min(uint32_t(x), columns - 2), j = std::min(uint32_t(y), rows - 2);
    const double* corner = &values[size_t(j) * columns + i];
    double top = corner[0] + (x - i) * (corner[1] - corner[0]);
    double bottom = corner[columns] + (x - i) * (corner[columns + 1] - corner[columns]);
    return top + (y - j) * (bottom - top);
}

double CanyonGround::height_m(double east, double south) const {
    return between(height_of, side, side, east * (side - 1), (0.25 + 0.5 * south) * (side - 1));
}

CanyonGround make_canyon_ground(uint64_t seed) {
    Grid height_m(kSide, kCell_m), uplift_m(kSide, kCell_m, 0), softness(kSide, kCell_m), steepest(kSide, kCell_m);
    std::vector<uint8_t> is_outlet(height_m.values.size(), 0);
    for (uint32_t row = 0; row < kSide; ++row)
        for (uint32_t column = 0; column < kSide; ++column) {
            double east = double(column) / (kSide - 1), south = double(row) / (kSide - 1);
            height_m.at(column, row) = plateau_m(seed, east, south);
            softness.at(column, row) = 1 + 0.7 * fractal_noise(seed + 5, east * 30, south * 30, 4);
            steepest.at(column, row) = 0.42 + 0.2 * fractal_noise(seed + 6, east * 50, south * 50, 3);
            if (column == 0 && std::abs(south - river_south(seed, 0)) * (kSide - 1) < 1.5) is_outlet[size_t(row) * kSide] = 1;
        }
    for (size_t i = 0; i < is_outlet.size(); ++i)
        if (is_outlet[i]) height_m.values[i] = kMouth_m;
    std::vector<double> plateau = height_m.values;

    Rivers rivers;
    rivers.seed = seed + 7;
    rivers.wander = 0.8;
    rivers.step = 0.15;
    rivers.step_count = 14;
    cut_rivers(height_m, uplift_m, softness, steepest, is_outlet, rivers);
    std::vector<double> area_m2 = drained_area_m2(drain(height_m, is_outlet, 0, 0), kCell_m);
    cut_ledges(height_m, plateau);

    CanyonGround ground{kSide, height_m.values, {}};
    for (double area : area_m2) ground.river.push_back(smooth_step(2e9, 8e9, area));
    return ground;
}

ImageRgb8 canyon_picture(const CanyonGround& ground, uint64_t seed) {
    relief::Field field{1024, 512, kCanyon.width_m / 1024, kCanyon.height_m / 512, std::vector<float>(1024 * 512)};
    auto place = [&](uint32_t i, uint32_t count) { return (i + 0.5) / count; };
    for (uint32_t row = 0; row < field.height; ++row)
        for (uint32_t column = 0; column < field.width; ++column)
            field.height_m[size_t(row) * field.width + column] =
                float(ground.height_m(place(column, field.width), place(row, field.height)));
    relief::Slopes slopes = relief::slopes_of(field);
    std::vector<float> sun_share = relief::sun_visibility(field, 315, 34), sky = relief::sky_visibility(field, 2);
    relief::Vector sun = relief::sun_direction(315, 34);

    ImageRgb8 image{field.width, field.height, std::vector<uint8_t>(field.height_m.size() * 3)};
    parallel_ranges(field.height, 16, [&](size_t begin, size_t end) {
        for (uint32_t row = uint32_t(begin); row < end; ++row)
            for (uint32_t column = 0; column < field.width; ++column) {
                size_t i = size_t(row) * field.width + column;
                double right = 1.6 * slopes.right[i], up = 1.6 * slopes.up[i], slope = std::sqrt(right * right + up * up) / 1.6;
                double facing = std::max(0.0, (sun[2] - right * sun[0] - up * sun[1]) / std::sqrt(1 + right * right + up * up));
                double light = 1.25 * facing * sun_share[i] + 0.42 * sky[i];
                Colour colour = ground_colour(ground, seed, place(column, field.width), place(row, field.height), slope);
                for (size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = relief::srgb_from_linear(colour[c] * light);
            }
    });
    return image;
}

}  // namespace overlook::sample
