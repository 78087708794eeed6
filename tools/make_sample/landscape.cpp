#include "tools/make_sample/landscape.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/make_sample/drainage.h"
#include "tools/make_sample/erosion.h"
#include "tools/make_sample/grid.h"
#include "tools/make_sample/noise.h"

namespace overlook::sample {
namespace {

constexpr double kBaseM = 300;  // height of the outlets
constexpr double kMarginShare =
    0.0625;  // of the side, worn down around the map and then cut off, so that its edges look like the rest
constexpr double kSteepest = 1.6;
constexpr uint32_t kCoarsestSide = 90;

// What the ground is like everywhere, at one resolution.
struct Ground {
    Grid uplift_m;     // metres a time unit
    Grid softness;     // against rivers
    Grid slope_limit;  // tangent at which rock falls
    Grid soil;         // 0..1, how much it creeps
    std::vector<uint8_t> is_outlet;
};

// Position of a grid line on the map: 0..1 over the part that is kept.
double map_position(uint32_t i, uint32_t side) {
    return double(i) / double(side - 1) * (1 + 2 * kMarginShare) - kMarginShare;
}

// 0 in the plain, 1 in the range, along fronts that wander.
double mountain_share(Relief relief, uint64_t seed, double u, double v) {
    double bend = 0.22 * fractal_noise(seed + 100, u * 2.1, v * 2.1, 3);
    if (relief == Relief::between) return 1.00 - 2.5 * std::abs(v - 0.62 + 0.1 * (u - 0.5)) + bend;
    return 0.58 * u + 0.74 * (1 - v) - 0.06 + bend;
}

void lay_ground(Ground& ground, Relief relief, uint64_t seed, double extent_m, size_t cell) {
    uint32_t side = ground.uplift_m.side;
    double u = map_position(uint32_t(cell % side), side), v = map_position(uint32_t(cell / side), side);
    double share = mountain_share(relief, seed, u, v);

    // Bend the plane before looking up the massifs.
    double km = extent_m / 1000, x = u * km, y = v * km;
    double wx = x + 2.6 * fractal_noise(seed + 200, x / 7, y / 7, 3);
    double wy = y + 2.6 * fractal_noise(seed + 300, x / 7, y / 7, 3);
    double massif = ridged_noise(seed + 400, wx / 13 + 0.37, wy / 13 + 0.61, 3);
    double hills = smooth_step(-0.1, 0.5, fractal_noise(seed + 500, wx / 6, wy / 6, 2));

    double range = smooth_step(0.28, 0.86, share);
    // Plains on either side are a little hilly up to their edges, and rivers cut them.
    bool is_between = relief == Relief::between;
    double foreland = is_between ? 1 : smooth_step(0.02, 0.30, share);
    double plain_uplift_m = is_between ? 26 : 2.5;
    ground.uplift_m.values[cell] = plain_uplift_m + 42 * foreland * hills + 640 * range * (0.16 + 0.84 * massif);
    ground.softness.values[cell] = 1 + 0.9 * fractal_noise(seed + 600, wx / 2, wy / 2, 5);
    double hardness = smooth_step(-0.25, 0.45, fractal_noise(seed + 700, wx / 1.3, wy / 1.3, 6));
    ground.slope_limit.values[cell] = 0.70 + range * (kSteepest - 0.70) * hardness;
    ground.soil.values[cell] = (is_between ? 0.3 : 1) - (is_between ? 0.15 : 0.85) * smooth_step(0.25, 0.6, share);
    bool is_low_edge = ground.uplift_m.is_border(cell) && share < 0.26;
    ground.is_outlet[cell] = is_low_edge;
}

Ground make_ground(Relief relief, uint64_t seed, uint32_t side, double cell_m) {
    Grid empty(side, cell_m);
    Ground ground{empty, empty, empty, empty, std::vector<uint8_t>(empty.values.size())};
    double extent_m = cell_m * (side - 1) / (1 + 2 * kMarginShare);
    parallel_ranges(empty.values.size(), 1 << 13, [&](size_t begin, size_t end) {
        for (size_t cell = begin; cell < end; ++cell) lay_ground(ground, relief, seed, extent_m, cell);
    });
    // The plain's corner always lets the water out.
    ground.is_outlet[size_t(side - 1) * side] = 1;
    return ground;
}

// The coarser heights between its samples, looked up a little beside where they stand and roughened, so that
// straight valleys bend and small ones find their own way.
Grid refine(const Grid& coarse, uint32_t side, double cell_m, uint64_t seed) {
    Grid fine(side, cell_m);
    double ratio = double(coarse.side - 1) / double(side - 1);
    for (uint32_t row = 0; row < side; ++row)
        for (uint32_t column = 0; column < side; ++column) {
            double x = column * ratio, y = row * ratio, last = coarse.side - 1;
            double bend_x = 1.5 * fractal_noise(seed + 20, x / 5, y / 5, 2),
                   bend_y = 1.5 * fractal_noise(seed + 30, x / 5, y / 5, 2);
            x = std::clamp(x + bend_x, 0.0, last);
            y = std::clamp(y + bend_y, 0.0, last);
            uint32_t i = std::min(uint32_t(x), coarse.side - 2), j = std::min(uint32_t(y), coarse.side - 2);
            double fx = x - i, fy = y - j;
            double top = coarse.at(i, j) + fx * (coarse.at(i + 1, j) - coarse.at(i, j));
            double bottom = coarse.at(i, j + 1) + fx * (coarse.at(i + 1, j + 1) - coarse.at(i, j + 1));
            double rough = cell_m * 0.3 * (unit_from_hash(hash_of(seed, column, row)) - 0.5);
            fine.at(column, row) = top + fy * (bottom - top) + rough;
        }
    return fine;
}

// Uplift against rivers, from a coarse grid to the finest: main valleys first.
Grid grow_range(Relief relief, uint64_t seed, uint32_t side, double cell_m, Ground& ground) {
    std::vector<uint32_t> sides = {side};
    while (sides.back() > kCoarsestSide) sides.push_back(sides.back() / 2 + 1);
    Grid height_m;
    for (size_t level = sides.size(); level-- > 0;) {
        double level_cell_m = cell_m * double(side - 1) / double(sides[level] - 1);
        ground = make_ground(relief, seed, sides[level], level_cell_m);
        bool is_first = height_m.values.empty();
        height_m =
            is_first ? Grid(sides[level], level_cell_m, kBaseM) : refine(height_m, sides[level], level_cell_m, seed + level);
        for (size_t i = 0; i < height_m.values.size(); ++i)
            if (ground.is_outlet[i])
                height_m.values[i] = kBaseM;
            else if (is_first)
                height_m.values[i] += 600 * unit_from_hash(hash_of(seed + 50, i, 0));
        Rivers rivers;
        rivers.seed = seed + 900 + level;
        rivers.wander = 0.9;
        rivers.step_count = is_first ? 120 : level >= 2 ? 40 : level == 1 ? 20 : 9;
        rivers.step = level == 0 ? 0.1 : 0.15;
        cut_rivers(height_m, ground.uplift_m, ground.softness, ground.slope_limit, ground.is_outlet, rivers);
    }
    return height_m;
}

// Deepens the trunk valley where it leaves the range, as a glacier would; filled to its brim it is a lake.
void dig_lake(Grid& height_m, const Ground& ground, Relief relief, uint64_t seed) {
    Drainage drainage = drain(height_m, ground.is_outlet, 0, 0);
    std::vector<double> area_m2 = drained_area_m2(drainage, height_m.cell_m);
    uint32_t side = height_m.side;
    size_t best = 0;
    double best_area_m2 = 0;
    for (size_t cell = 0; cell < area_m2.size(); ++cell) {
        double u = map_position(uint32_t(cell % side), side), v = map_position(uint32_t(cell / side), side);
        double share = mountain_share(relief, seed, u, v);
        bool is_in_front = share > 0.36 && share < 0.46 && u > 0.2 && u < 0.8 && v > 0.2 && v < 0.8;
        if (!is_in_front || area_m2[cell] <= best_area_m2) continue;
        best_area_m2 = area_m2[cell];
        best = cell;
    }
    if (best_area_m2 == 0) return;
    double radius = 0.07 * side / (1 + 2 * kMarginShare);
    double depth_m = 0.006 * height_m.cell_m * side;
    double brim_m = height_m.values[best] + 0.35 * depth_m;
    double column = double(best % side), row = double(best / side);
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            double dx = (x - column) / radius, dy = (y - row) / radius;
            double off = dx * dx + dy * dy + 1.3 * fractal_noise(seed + 800, dx * 0.9, dy * 0.9, 4);
            if (off >= 1) continue;
            double& here_m = height_m.at(x, y);
            double low = 1 - smooth_step(brim_m, brim_m + 1.2 * depth_m, here_m);
            here_m -= depth_m * (1 - off) * low;
        }
}

// Gullies and crags on steep ground, too small for the rivers.
void roughen_slopes(Grid& height_m, double extent_m, uint64_t seed) {
    Grid before = height_m;
    uint32_t side = height_m.side;
    parallel_ranges(side - 2, 16, [&](size_t begin, size_t end) {
        for (uint32_t row = uint32_t(begin) + 1; row <= end; ++row)
            for (uint32_t column = 1; column + 1 < side; ++column) {
                double east = before.at(column + 1, row) - before.at(column - 1, row);
                double south = before.at(column, row + 1) - before.at(column, row - 1);
                double slope = std::sqrt(east * east + south * south) / (2 * before.cell_m);
                double amount_m = 26 * smooth_step(0.25, 0.80, slope);
                if (amount_m <= 0) continue;
                double x = map_position(column, side) * extent_m, y = map_position(row, side) * extent_m;
                double bend_m = 120 * gradient_noise(seed + 950, x / 500, y / 500);
                height_m.at(column, row) +=
                    amount_m * (ridged_noise(seed + 960, (x + bend_m) / 420, (y - bend_m) / 420, 4) - 0.6);
            }
    });
}

Landscape cut_out(const Grid& height_m, uint32_t margin, uint32_t side) {
    Landscape out{side, std::vector<float>(size_t(side) * side), kSteepest};
    for (uint32_t row = 0; row < side; ++row)
        for (uint32_t column = 0; column < side; ++column) {
            double steps = std::floor(height_m.at(column + margin, row + margin) / kHeightStepM + 0.5);
            out.height_m[size_t(row) * side + column] = float(steps * kHeightStepM);
        }
    return out;
}

}  // namespace

Landscape make_landscape(const LandscapeOptions& options) {
    uint64_t seed = hash_of(options.seed, 1, 2) >> 1;
    uint32_t margin = uint32_t(double(options.side) * kMarginShare);
    Ground ground;
    Grid height_m = grow_range(options.relief, seed, options.side + 2 * margin, options.cell_size_m, ground);

    widen_valleys(height_m, ground.is_outlet, 2.5e6, 75);
    dig_lake(height_m, ground, options.relief, seed);
    roughen_slopes(height_m, options.cell_size_m * (options.side - 1), seed);

    Grid creep = ground.soil;
    for (double& strength : creep.values) strength = 0.15 * strength;
    creep_soil(height_m, creep, 6);
    fall_rock(height_m, ground.slope_limit);
    fill_depressions(height_m, ground.is_outlet);
    return cut_out(height_m, margin, options.side);
}

}  // namespace overlook::sample
