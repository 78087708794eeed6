#include "tools/bake/relief_light.h"

#include <algorithm>
#include <cmath>

#include "formats/parallel.h"

namespace overlook::relief {
namespace {

constexpr double kRadians = 3.14159265358979323846 / 180;
constexpr double kNoShadowM = -1e30;  // finite, so that points between two of them have a height too
constexpr std::array<int, 11> kReach = {1, 2, 3, 5, 8, 12, 18, 26, 36, 48, 64};  // cells

// Rise per metre from the valid ones of two neighbours and the cell between them.
float slope_between(float before, float here, float after, double cell_m) {
    bool has_before = !std::isnan(before), has_after = !std::isnan(after);
    if (has_before && has_after) return float((double(after) - before) / (2 * cell_m));
    if (has_after) return float((double(after) - here) / cell_m);
    if (has_before) return float((double(here) - before) / cell_m);
    return 0;
}

// The sweep's way over the grid: along `major` one line at a time towards where the shadow falls,
// `minor_shift` cells sideways a line.
struct Sweep {
    bool is_by_rows = true;
    int step = 1;
    double minor_shift = 0;
    double distance_m = 1;  // between a cell and the point on the line before
};

Sweep sweep_of(const Field& field, double azimuth_deg) {
    // Towards the sun, in cells: x to the right, y down the raster.
    double x = std::sin(azimuth_deg * kRadians) / field.column_m, y = -std::cos(azimuth_deg * kRadians) / field.row_m;
    Sweep sweep;
    sweep.is_by_rows = std::abs(y) >= std::abs(x);
    double major = sweep.is_by_rows ? y : x, minor = sweep.is_by_rows ? x : y;
    sweep.step = major < 0 ? 1 : -1;
    sweep.minor_shift = minor / std::abs(major);
    sweep.distance_m = 1 / std::abs(major);
    return sweep;
}

// The height of the shadow on the line before, between two cells; kNoShadowM off the grid.
double shadow_at(const std::vector<double>& line, double position) {
    double below = std::floor(position);
    int64_t i = int64_t(below), last = int64_t(line.size()) - 1;
    double share = position - below;
    if (i < 0 || i > last || (i == last && share > 0)) return kNoShadowM;
    return share > 0 ? line[size_t(i)] + share * (line[size_t(i) + 1] - line[size_t(i)]) : line[size_t(i)];
}

float sky_of_cell(const Field& field, double exaggeration, int64_t column, int64_t row) {
    static constexpr double kC = 0.9238795325112867, kD = 0.7071067811865476, kS = 0.3826834323650898;
    static constexpr std::array<std::array<double, 2>, 16> kDirections = {{{1, 0},
                                                                           {kC, kS},
                                                                           {kD, kD},
                                                                           {kS, kC},
                                                                           {0, 1},
                                                                           {-kS, kC},
                                                                           {-kD, kD},
                                                                           {-kC, kS},
                                                                           {-1, 0},
                                                                           {-kC, -kS},
                                                                           {-kD, -kD},
                                                                           {-kS, -kC},
                                                                           {0, -1},
                                                                           {kS, -kC},
                                                                           {kD, -kD},
                                                                           {kC, -kS}}};
    double here = field.at(uint32_t(column), uint32_t(row));
    double sum = 0;
    for (const auto& direction : kDirections) {
        double steepest = 0;
        for (int reach : kReach) {
            int64_t dx = int64_t(std::lround(direction[0] * reach)), dy = int64_t(std::lround(direction[1] * reach));
            int64_t x = column + dx, y = row + dy;
            if (x < 0 || y < 0 || x >= field.width || y >= field.height) break;
            double rise = double(field.at(uint32_t(x), uint32_t(y))) - here;
            if (!(rise > 0)) continue;
            double east_m = double(dx) * field.column_m, north_m = double(dy) * field.row_m;
            steepest = std::max(steepest, rise * rise / (east_m * east_m + north_m * north_m));
        }
        sum += 1 / (1 + steepest * exaggeration * exaggeration);
    }
    return float(sum / kDirections.size());
}

}  // namespace

Vector sun_direction(double azimuth_deg, double altitude_deg) {
    double level = std::cos(altitude_deg * kRadians);
    return {level * std::sin(azimuth_deg * kRadians), level * std::cos(azimuth_deg * kRadians),
            std::sin(altitude_deg * kRadians)};
}

Slopes slopes_of(const Field& field) {
    Slopes out{std::vector<float>(field.height_m.size()), std::vector<float>(field.height_m.size())};
    parallel_ranges(field.height, 16, [&](size_t begin, size_t end) {
        for (uint32_t row = uint32_t(begin); row < end; ++row)
            for (uint32_t column = 0; column < field.width; ++column) {
                float here = field.at(column, row);
                if (std::isnan(here)) continue;
                float left = column > 0 ? field.at(column - 1, row) : NAN;
                float right = column + 1 < field.width ? field.at(column + 1, row) : NAN;
                float above = row > 0 ? field.at(column, row - 1) : NAN;
                float below = row + 1 < field.height ? field.at(column, row + 1) : NAN;
                size_t i = size_t(row) * field.width + column;
                out.right[i] = slope_between(left, here, right, field.column_m);
                out.up[i] = slope_between(below, here, above, field.row_m);
            }
    });
    return out;
}

std::vector<float> sun_visibility(const Field& field, double azimuth_deg, double altitude_deg) {
    Sweep sweep = sweep_of(field, azimuth_deg);
    double fall_m = sweep.distance_m * std::tan(altitude_deg * kRadians);
    uint32_t lines = sweep.is_by_rows ? field.height : field.width, length = sweep.is_by_rows ? field.width : field.height;
    std::vector<float> visibility(field.height_m.size(), 1.0f);
    std::vector<double> before(length, kNoShadowM), line(length);
    for (uint32_t n = 0; n < lines; ++n) {
        uint32_t major = sweep.step > 0 ? n : lines - 1 - n;
        for (uint32_t minor = 0; minor < length; ++minor) {
            size_t i = sweep.is_by_rows ? size_t(major) * field.width + minor : size_t(minor) * field.width + major;
            double here_m = field.height_m[i];
            double shadow_m = shadow_at(before, minor + sweep.minor_shift) - fall_m;
            bool is_void = std::isnan(here_m);
            if (!is_void) visibility[i] = float(std::clamp(0.5 - (shadow_m - here_m) / fall_m, 0.0, 1.0));
            line[minor] = is_void ? shadow_m : std::max(here_m, shadow_m);
        }
        std::swap(before, line);
    }
    return visibility;
}

std::vector<float> sky_visibility(const Field& field, double exaggeration) {
    std::vector<float> visibility(field.height_m.size(), 1.0f);
    parallel_ranges(field.height, 8, [&](size_t begin, size_t end) {
        for (uint32_t row = uint32_t(begin); row < end; ++row)
            for (uint32_t column = 0; column < field.width; ++column)
                if (!std::isnan(field.at(column, row)))
                    visibility[size_t(row) * field.width + column] = sky_of_cell(field, exaggeration, column, row);
    });
    return visibility;
}

std::vector<float> local_mean(const Field& field, uint32_t radius) {
    // Sums and counts along rows, then down columns of those.
    size_t width = field.width, height = field.height;
    std::vector<double> sums(width * height), counts(width * height);
    parallel_ranges(height, 16, [&](size_t begin, size_t end) {
        std::vector<double> sum(width + 1), count(width + 1);
        for (size_t row = begin; row < end; ++row) {
            for (size_t x = 0; x < width; ++x) {
                float here = field.height_m[row * width + x];
                sum[x + 1] = sum[x] + (std::isnan(here) ? 0.0 : double(here));
                count[x + 1] = count[x] + (std::isnan(here) ? 0.0 : 1.0);
            }
            for (size_t x = 0; x < width; ++x) {
                size_t from = x > radius ? x - radius : 0, to = std::min(width, x + radius + 1);
                sums[row * width + x] = sum[to] - sum[from];
                counts[row * width + x] = count[to] - count[from];
            }
        }
    });
    std::vector<float> mean(width * height, NAN);
    parallel_ranges(width, 32, [&](size_t begin, size_t end) {
        std::vector<double> sum(end - begin), count(end - begin);
        auto add = [&](size_t row, double sign) {
            for (size_t x = begin; x < end; ++x) {
                sum[x - begin] += sign * sums[row * width + x];
                count[x - begin] += sign * counts[row * width + x];
            }
        };
        for (size_t row = 0; row < std::min<size_t>(radius, height); ++row) add(row, 1);
        for (size_t row = 0; row < height; ++row) {
            if (row + radius < height) add(row + radius, 1);
            if (row > radius) add(row - radius - 1, -1);
            for (size_t x = begin; x < end; ++x)
                if (!std::isnan(field.height_m[row * width + x]))
                    mean[row * width + x] = float(sum[x - begin] / count[x - begin]);
        }
    });
    return mean;
}

}  // namespace overlook::relief
