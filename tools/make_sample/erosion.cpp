// Based on: Jean Braun, Sean Willett, "A very efficient O(n), implicit and parallel method to solve the
// stream power equation", Geomorphology 180, 2013; Guillaume Cordonnier et al., "Large Scale Terrain
// Generation from Tectonic Uplift and Fluvial Erosion", Computer Graphics Forum 35 (Eurographics), 2016.
#include "tools/make_sample/erosion.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"
#include "tools/make_sample/drainage.h"

namespace overlook::sample {
namespace {

double cells_between(uint32_t side, uint32_t a, uint32_t b) {
    return a / side != b / side && a % side != b % side ? kDiagonal : 1.0;
}

// One sweep over the rows, each cell against the four neighbours already visited; true if anything moved.
bool sweep_rock(Grid& height_m, const Grid& slope_limit, bool forward) {
    size_t count = height_m.values.size();
    bool has_moved = false;
    for (size_t i = 0; i < count; ++i) {
        size_t cell = forward ? i : count - 1 - i;
        double lowest = height_m.values[cell];
        double reach = slope_limit.values[cell] * height_m.cell_m;
        for_neighbours(height_m.side, cell, [&](size_t next, double distance, size_t) {
            lowest = std::min(lowest, height_m.values[next] + reach * distance);
        });
        has_moved = has_moved || lowest < height_m.values[cell];
        height_m.values[cell] = lowest;
    }
    return has_moved;
}

}  // namespace

void cut_rivers(Grid& height_m, const Grid& uplift_m, const Grid& softness, const Grid& slope_limit,
                const std::vector<uint8_t>& is_outlet, const Rivers& rivers) {
    for (int step = 0; step < rivers.step_count; ++step) {
        Drainage drainage = drain(height_m, is_outlet, rivers.wander, rivers.seed);
        std::vector<double> area_m2 = drained_area_m2(drainage, height_m.cell_m);
        for (uint32_t cell : drainage.order) {
            uint32_t receiver = drainage.receiver[cell];
            if (receiver == cell) continue;
            double distance_m = height_m.cell_m * cells_between(height_m.side, cell, receiver);
            double pull = softness.values[cell] * rivers.step * std::sqrt(area_m2[cell]) / distance_m;
            double lifted_m = height_m.values[cell] + rivers.step * uplift_m.values[cell];
            double below_m = height_m.values[receiver];
            double cut_m = (lifted_m + pull * below_m) / (1 + pull);
            height_m.values[cell] = std::min(cut_m, below_m + slope_limit.values[cell] * distance_m);
        }
    }
}

void fall_rock(Grid& height_m, const Grid& slope_limit) {
    bool forward = true;
    while (sweep_rock(height_m, slope_limit, forward)) forward = !forward;
}

void creep_soil(Grid& height_m, const Grid& strength, int passes) {
    std::vector<double> before;
    size_t side = height_m.side;
    for (int pass = 0; pass < passes; ++pass) {
        before = height_m.values;
        parallel_ranges(side, 32, [&](size_t begin, size_t end) {
            for (size_t row = std::max<size_t>(1, begin); row < std::min(end, side - 1); ++row)
                for (size_t i = row * side + 1; i + 1 < (row + 1) * side; ++i) {
                    double around = before[i - 1] + before[i + 1] + before[i - side] + before[i + side];
                    height_m.values[i] += strength.values[i] * (around - 4 * before[i]);
                }
        });
    }
}

void widen_valleys(Grid& height_m, const std::vector<uint8_t>& is_outlet, double least_area_m2, double width_m) {
    Drainage drainage = drain(height_m, is_outlet, 0, 0);
    std::vector<double> area_m2 = drained_area_m2(drainage, height_m.cell_m);
    std::vector<double> river_m = height_m.values;
    int64_t side = height_m.side;
    for (int64_t cell = 0; cell < side * side; ++cell) {
        double area = area_m2[size_t(cell)];
        if (area < least_area_m2) continue;
        double half_m = width_m * std::sqrt(std::sqrt(area / 1e6)) * std::min(1.0, area / least_area_m2 - 1);
        if (half_m <= 0) continue;
        int64_t reach = int64_t(3 * half_m / height_m.cell_m);
        int64_t column = cell % side, row = cell / side;
        for (int64_t y = std::max<int64_t>(0, row - reach); y <= std::min(side - 1, row + reach); ++y)
            for (int64_t x = std::max<int64_t>(0, column - reach); x <= std::min(side - 1, column + reach); ++x) {
                double dx = double(x - column), dy = double(y - row);
                double beyond = std::sqrt(dx * dx + dy * dy) * height_m.cell_m / half_m;
                double floor_m = river_m[size_t(cell)] + half_m * (0.02 * beyond + 0.14 * beyond * beyond * beyond);
                double& here_m = height_m.values[size_t(y * side + x)];
                here_m = std::min(here_m, floor_m);
            }
    }
}

size_t fill_depressions(Grid& height_m, const std::vector<uint8_t>& is_outlet) {
    Drainage drainage = drain(height_m, is_outlet, 0, 0);
    size_t raised = 0;
    for (size_t i = 0; i < height_m.values.size(); ++i) raised += drainage.filled_m[i] > height_m.values[i];
    height_m.values = std::move(drainage.filled_m);
    return raised;
}

}  // namespace overlook::sample
