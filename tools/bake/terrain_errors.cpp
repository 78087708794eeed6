#include "tools/bake/terrain_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "formats/parallel.h"
#include "formats/terrain_diamond.h"

namespace overlook::terrain {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
// No two heights are 2^29 steps apart and a void is more than 2^30 away from any: a greater deviation means a void.
constexpr double kVoidDeviation = 1u << 30;
constexpr size_t kRowsAtATime = 16;

struct Field {
    const Shape& shape;
    std::span<const int32_t> heights;

    int32_t at(int64_t column, int64_t row) const { return heights[size_t(row) * shape.width + size_t(column)]; }
    const int32_t* row(int64_t y) const { return heights.data() + size_t(y) * shape.width; }
};

// A plane over the raster, z = base + slope_x * (column - x0) + slope_y * (row - y0).
struct Plane {
    double base, slope_x, slope_y;
    int64_t x0, y0;
    double at(int64_t column, int64_t row) const { return base + slope_x * double(column - x0) + slope_y * double(row - y0); }
};

// Greatest |plane - sample| over columns [begin, end] of one row.
inline double row_deviation(const Field& field, const Plane& plane, int64_t row, int64_t begin, int64_t end) {
    const int32_t* heights = field.row(row) + begin;
    double z = plane.at(begin, row), slope = plane.slope_x, greatest = 0;
    for (int64_t i = 0, count = end - begin; i <= count; ++i)
        greatest = std::max(greatest, std::abs(z + slope * double(int32_t(i)) - double(heights[i])));
    return greatest;
}

Plane plane_through(const Field& field, const std::array<GridPoint, 3>& p) {
    int64_t ax = p[0].x, ay = p[0].y;
    int64_t ux = int64_t(p[1].x) - ax, uy = int64_t(p[1].y) - ay, vx = int64_t(p[2].x) - ax, vy = int64_t(p[2].y) - ay;
    double za = field.at(ax, ay), du = field.at(p[1].x, p[1].y) - za, dv = field.at(p[2].x, p[2].y) - za;
    double area = double(ux * vy - uy * vx);
    return {za, (du * double(vy) - dv * double(uy)) / area, (dv * double(ux) - du * double(vx)) / area, ax, ay};
}

int64_t floor_div(int64_t a, int64_t b) {
    return a / b - (a % b != 0 && (a % b < 0) != (b < 0));
}
int64_t ceil_div(int64_t a, int64_t b) {
    return -floor_div(-a, b);
}

// Narrows [begin, end] to the columns of `row` on the inner side of edge p -> q (inside: cross product >= 0 with `sign`).
void clip_to_edge(GridPoint p, GridPoint q, int64_t sign, int64_t row, int64_t& begin, int64_t& end) {
    int64_t dx = int64_t(q.x) - p.x, dy = int64_t(q.y) - p.y;
    // sign * (dx * (row - p.y) - dy * (column - p.x)) >= 0
    int64_t constant = sign * (dx * (row - int64_t(p.y)) + dy * int64_t(p.x)), factor = sign * dy;
    if (factor > 0) end = std::min(end, floor_div(constant, factor));
    if (factor < 0) begin = std::max(begin, ceil_div(constant, factor));
    if (factor == 0 && constant < 0) end = begin - 1;
}

// Any triangle over raster samples, closed: every sample inside or on its border.
double triangle_deviation(const Field& field, const std::array<GridPoint, 3>& p) {
    for (GridPoint corner : p)
        if (field.at(corner.x, corner.y) == kVoid) return kInfinite;
    Plane plane = plane_through(field, p);
    int64_t area =
        (int64_t(p[1].x) - p[0].x) * (int64_t(p[2].y) - p[0].y) - (int64_t(p[1].y) - p[0].y) * (int64_t(p[2].x) - p[0].x);
    int64_t sign = area > 0 ? 1 : -1;
    auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
    auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
    double greatest = 0;
    for (int64_t row = low_y; row <= high_y; ++row) {
        int64_t begin = low_x, end = high_x;
        for (int i = 0; i < 3; ++i) clip_to_edge(p[i], p[(i + 1) % 3], sign, row, begin, end);
        if (begin <= end) greatest = std::max(greatest, row_deviation(field, plane, row, begin, end));
        if (greatest >= kVoidDeviation) return kInfinite;
    }
    return greatest;
}

double squeezed_deviation(const Field& field, const Triangle& t) {
    if (is_degenerate(field.shape, t)) return 0;
    return triangle_deviation(field,
                              {sample_of(field.shape, t.apex), sample_of(field.shape, t.left), sample_of(field.shape, t.right)});
}

// A triangle with a horizontal base row and rows that shrink (or grow) by whole samples: begin and end move by -1, 0 or 1 a row.
struct Trapezoid {
    int64_t row, rows, begin, end, begin_step, end_step;
};

double trapezoid_deviation(const Field& field, const Plane& plane, Trapezoid t) {
    double greatest = 0;
    for (int64_t i = 0; i < t.rows; ++i)
        greatest = std::max(greatest, row_deviation(field, plane, t.row + i, t.begin + i * t.begin_step, t.end + i * t.end_step));
    return greatest >= kVoidDeviation ? double(kInfinite) : greatest;
}

// Both triangles of a square diamond that lies within the raster: split along its diagonal, right angles at the other corners.
double square_deviation(const Field& field, int64_t x, int64_t y, int64_t s, uint32_t level) {
    int64_t west = x - s, east = x + s, north = y - s, south = y + s;
    int32_t nw = field.at(west, north), ne = field.at(east, north), sw = field.at(west, south), se = field.at(east, south);
    if (nw == kVoid || ne == kVoid || sw == kVoid || se == kVoid) return kInfinite;
    double side = double(2 * s), top = (double(ne) - nw) / side, bottom = (double(se) - sw) / side,
           left = (double(sw) - nw) / side, right = (double(se) - ne) / side;
    if (is_main_diagonal(uint32_t(west) >> (level + 1), uint32_t(north) >> (level + 1))) {
        double upper = trapezoid_deviation(field, {double(nw), top, right, west, north}, {north, 2 * s + 1, west, east, 1, 0});
        double lower = trapezoid_deviation(field, {double(nw), bottom, left, west, north}, {north, 2 * s + 1, west, west, 0, 1});
        return std::max(upper, lower);
    }
    double upper = trapezoid_deviation(field, {double(nw), top, left, west, north}, {north, 2 * s + 1, west, east, 0, -1});
    double lower = trapezoid_deviation(field, {double(ne), bottom, right, east, north}, {north, 2 * s + 1, east, east, -1, 0});
    return std::max(upper, lower);
}

// One triangle of an edge diamond within the raster: base from (x-s, y) to (x+s, y), apex at (x, y+direction*s).
double horizontal_deviation(const Field& field, int64_t x, int64_t y, int64_t s, int64_t direction) {
    int32_t west = field.at(x - s, y), east = field.at(x + s, y), apex = field.at(x, y + direction * s);
    if (west == kVoid || east == kVoid || apex == kVoid) return kInfinite;
    double along = (double(east) - west) / double(2 * s), middle = (double(east) + west) / 2;
    Plane plane{middle, along, double(direction) * (apex - middle) / double(s), x, y};
    if (direction > 0) return trapezoid_deviation(field, plane, {y, s + 1, x - s, x + s, 1, -1});
    return trapezoid_deviation(field, plane, {y - s, s + 1, x, x, -1, 1});
}

// Base from (x, y-s) to (x, y+s), apex at (x+direction*s, y).
double vertical_deviation(const Field& field, int64_t x, int64_t y, int64_t s, int64_t direction) {
    int32_t north = field.at(x, y - s), south = field.at(x, y + s), apex = field.at(x + direction * s, y);
    if (north == kVoid || south == kVoid || apex == kVoid) return kInfinite;
    double along = (double(south) - north) / double(2 * s), middle = (double(south) + north) / 2;
    Plane plane{middle, double(direction) * (apex - middle) / double(s), along, x, y};
    int64_t outward = direction > 0 ? 1 : 0, inward = 1 - outward;
    double upper = trapezoid_deviation(field, plane, {y - s, s + 1, x, x, -inward, outward});
    double lower = trapezoid_deviation(field, plane, {y, s + 1, x - inward * s, x + outward * s, inward, -outward});
    return std::max(upper, lower);
}

double diamond_deviation(const Field& field, uint32_t x, uint32_t y, uint32_t level) {
    const Shape& shape = field.shape;
    int64_t s = int64_t(1) << level;
    bool inside = x + s < int64_t(shape.width) && y + s < int64_t(shape.height) && x >= s && y >= s;
    if (!inside) {
        Triangle triangles[2];
        int count = triangles_of_diamond(shape, x, y, level, triangles);
        double greatest = 0;
        for (int i = 0; i < count; ++i) greatest = std::max(greatest, squeezed_deviation(field, triangles[i]));
        return greatest;
    }
    switch (diamond_kind(x, y, level)) {
        case DiamondKind::square:
            return square_deviation(field, x, y, s, level);
        case DiamondKind::horizontal_edge:
            return std::max(horizontal_deviation(field, x, y, s, -1), horizontal_deviation(field, x, y, s, 1));
        default:
            return std::max(vertical_deviation(field, x, y, s, -1), vertical_deviation(field, x, y, s, 1));
    }
}

float rounded_up(double value) {
    float rounded = float(value);
    return double(rounded) < value ? std::nextafter(rounded, kInfinite) : rounded;
}

struct Level {
    LevelGrid grid;
    std::vector<float> errors;
    // The error stored for grid coordinates (i, j), which may lie outside: nothing drawn depends on it then.
    float at(int64_t i, int64_t j) const {
        bool inside = i >= 0 && j >= 0 && i < int64_t(grid.columns) && j < int64_t(grid.rows);
        return inside ? errors[size_t(j) * grid.columns + size_t(i)] : 0;
    }
};

// Calls fill(i, j) for every grid vertex of the level that is the middle of a square (or else of an edge) and stores what it
// returns.
template <class Fill>
void fill_diamonds(Level& level, bool squares, const Fill& fill) {
    parallel_ranges(level.grid.rows, kRowsAtATime, [&](size_t first, size_t end) {
        for (uint32_t j = uint32_t(first); j < end; ++j) {
            if (squares && j % 2 == 0) continue;
            uint32_t start = squares || j % 2 == 0 ? 1 : 0;
            for (uint32_t i = start; i < level.grid.columns; i += 2)
                level.errors[size_t(j) * level.grid.columns + i] = fill(i, j);
        }
    });
}

float greatest_of_four(float a, float b, float c, float d) {
    return std::max(std::max(a, b), std::max(c, d));
}

}  // namespace

std::vector<std::vector<float>> measure_split_errors(const Shape& shape, std::span<const int32_t> heights) {
    Field field{shape, heights};
    std::vector<Level> levels(shape.root_log2);
    for (uint32_t t = 0; t < shape.root_log2; ++t) {
        Level& level = levels[t];
        level.grid = level_grid(shape, t);
        level.errors.assign(size_t(level.grid.columns) * level.grid.rows, 0);
        auto with_own = [&](float of_children, uint32_t i, uint32_t j) {
            if (of_children == kInfinite) return kInfinite;
            return std::max(of_children, rounded_up(diamond_deviation(field, i << t, j << t, t)));
        };
        // An edge splits into squares of half the size, whose middles lie diagonally beside it.
        fill_diamonds(level, false, [&](uint32_t i, uint32_t j) {
            float children = 0;
            if (t > 0) {
                const Level& finer = levels[t - 1];
                int64_t x = 2 * int64_t(i), y = 2 * int64_t(j);
                children = greatest_of_four(finer.at(x - 1, y - 1), finer.at(x + 1, y - 1), finer.at(x - 1, y + 1),
                                            finer.at(x + 1, y + 1));
            }
            return with_own(children, i, j);
        });
        // A square splits into edges of its own level, above, below and beside it.
        fill_diamonds(level, true, [&](uint32_t i, uint32_t j) {
            int64_t x = i, y = j;
            return with_own(greatest_of_four(level.at(x - 1, y), level.at(x + 1, y), level.at(x, y - 1), level.at(x, y + 1)), i,
                            j);
        });
    }
    std::vector<std::vector<float>> errors;
    for (Level& level : levels) errors.push_back(std::move(level.errors));
    return errors;
}

}  // namespace overlook::terrain
