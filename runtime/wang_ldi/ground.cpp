#include "runtime/wang_ldi/ground.h"

#include <algorithm>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

constexpr double kPlain_m = 1e7;

// The edges of the ground's triangles lie on four families of lines: whole columns, whole rows, and those where column - row or
// column + row is even. Visits where the segment from p to q crosses any of them: between two such places the ground is straight.
template <class Visit>
void visit_crossings(const glm::dvec2& p, const glm::dvec2& q, const Visit& visit) {
    auto family = [&](double at_p, double at_q, double step) {
        if (at_p == at_q) return;
        double last = std::max(at_p, at_q);
        for (double value = std::ceil(std::min(at_p, at_q) / step) * step; value <= last; value += step)
            visit(p + (q - p) * ((value - at_p) / (at_q - at_p)));
    };
    family(p.x, q.x, 1), family(p.y, q.y, 1);
    family(p.x - p.y, q.x - q.y, 2), family(p.x + p.y, q.x + q.y, 2);
}

// South-west, south-east, north-west, north-east.
std::array<glm::dvec2, 4> corners_of(const Rect& rect) {
    return {rect.low_m, {rect.high_m.x, rect.low_m.y}, {rect.low_m.x, rect.high_m.y}, rect.high_m};
}

double square_of_rise(double along_columns, double along_rows, const glm::dvec2& cells_per_m) {
    double x = along_columns * cells_per_m.x, y = along_rows * cells_per_m.y;
    return x * x + y * y;
}

}  // namespace

void Ground::Cells::take(const Cells& other) {
    low = std::min(low, other.low), high = std::max(high, other.high);
    steepest = std::max(steepest, other.steepest);
}

Ground Ground::plain(double height_m) {
    Ground ground;
    ground.plain_height_m_ = height_m;
    ground.extent_ = {glm::dvec2(-kPlain_m), glm::dvec2(kPlain_m)};
    return ground;
}

Ground::Ground(const terrain::Terrain& terrain)
    : terrain_(&terrain), cells_per_m_(1 / terrain.frame.metres_per_column, 1 / terrain.frame.metres_per_row) {
    uint32_t columns = terrain.shape.width - 1, rows = terrain.shape.height - 1;
    extent_ = {{0, -(rows * terrain.frame.metres_per_row)}, {columns * terrain.frame.metres_per_column, 0}};
    pyramid_ = Pyramid<Cells>(columns, rows, [&](uint32_t column, uint32_t row) { return cell(column, row); });
}

glm::dvec2 Ground::grid_of(const glm::dvec2& at_m) const {
    return {at_m.x / terrain_->frame.metres_per_column, -at_m.y / terrain_->frame.metres_per_row};
}

Ground::Cells Ground::cell(uint32_t column, uint32_t row) const {
    Cells cells;
    double heights[2][2] = {};
    for (uint32_t j = 0; j < 2; ++j)
        for (uint32_t i = 0; i < 2; ++i) {
            int32_t steps = terrain_->heights[size_t(row + j) * terrain_->shape.width + column + i];
            if (steps == terrain::kVoid)
                cells.steepest = std::numeric_limits<float>::infinity();
            else
                cells.low = std::min(cells.low, steps), cells.high = std::max(cells.high, steps);
            heights[j][i] = terrain_->height_step_m * steps;
        }
    if (std::isinf(cells.steepest)) return cells;
    // The diagonal joins the samples whose column + row is even: a triangle has one whole row's side and one whole column's.
    double top = heights[0][1] - heights[0][0], bottom = heights[1][1] - heights[1][0];
    double left = heights[1][0] - heights[0][0], right = heights[1][1] - heights[0][1];
    bool falls = (column + row) % 2 == 0;
    double one = square_of_rise(top, falls ? right : left, cells_per_m_);
    double other = square_of_rise(bottom, falls ? left : right, cells_per_m_);
    constexpr float kMore = 1 + 0x1p-21f;  // than rounding takes away
    cells.steepest = kMore * float(std::sqrt(std::max(one, other)));
    return cells;
}

double Ground::height_at(const glm::dvec2& grid) const {
    Asked asked;
    return height_at(grid, asked);
}

double Ground::height_at(const glm::dvec2& grid, Asked& asked) const {
    const terrain::Shape& shape = terrain_->shape;
    auto column = uint32_t(std::clamp(grid.x, 0.0, double(shape.width - 2)));
    auto row = uint32_t(std::clamp(grid.y, 0.0, double(shape.height - 2)));
    if (column != asked.column || row != asked.row) {
        auto height = [&](uint32_t i, uint32_t j) {
            return terrain_->is_void(column + i, row + j) ? NAN : terrain_->height_m(column + i, row + j);
        };
        asked = {column, row, {height(0, 0), height(1, 0), height(0, 1), height(1, 1)}};
    }
    auto [h00, h10, h01, h11] = asked.corners_m;
    double x = std::clamp(grid.x - column, 0.0, 1.0), y = std::clamp(grid.y - row, 0.0, 1.0);
    // The corner that the triangle's right angle is at, and its two neighbours along the row and along the column.
    double corner, along_row, along_column;
    if ((column + row) % 2 == 0) {
        bool is_upper = x >= y;
        corner = is_upper ? h10 : h01, along_row = is_upper ? h00 : h11, along_column = is_upper ? h11 : h00;
        x = is_upper ? 1 - x : x, y = is_upper ? y : 1 - y;
    } else {
        bool is_upper = x + y <= 1;
        corner = is_upper ? h00 : h11, along_row = is_upper ? h10 : h01, along_column = is_upper ? h01 : h10;
        x = is_upper ? x : 1 - x, y = is_upper ? y : 1 - y;
    }
    if (std::isnan(h00 + h10 + h01 + h11)) return NAN;
    return std::clamp(corner + x * (along_row - corner) + y * (along_column - corner),
                      std::min({corner, along_row, along_column}), std::max({corner, along_row, along_column}));
}

double Ground::height_m(const glm::dvec2& at_m) const {
    return terrain_ ? height_at(grid_of(at_m)) : plain_height_m_;
}

double Ground::lowest_m(const glm::dvec2& p, const glm::dvec2& q, Asked& asked) const {
    if (!terrain_) return plain_height_m_;
    glm::dvec2 first = grid_of(p), last = grid_of(q);
    double lowest_m = height_at(first, asked);
    auto take = [&](const glm::dvec2& grid) {
        double height = height_at(grid, asked);
        if (!(height >= lowest_m)) lowest_m = std::isnan(lowest_m) ? lowest_m : height;
    };
    visit_crossings(first, last, take);
    take(last);
    return lowest_m;
}

// Of a rectangle that reaches into the extent.
Ground::Touched Ground::touched_by(const Rect& rect) const {
    glm::dvec2 first = grid_of({rect.low_m.x, rect.high_m.y}), last = grid_of({rect.high_m.x, rect.low_m.y});
    double right = terrain_->shape.width - 2, bottom = terrain_->shape.height - 2;
    auto clamped = [](double value, double most) { return uint32_t(std::clamp(value, 0.0, most)); };
    return {clamped(std::floor(first.x), right), clamped(std::floor(first.y), bottom), clamped(std::ceil(last.x) - 1, right),
            clamped(std::ceil(last.y) - 1, bottom)};
}

template <class Visit>
void Ground::visit_samples_inside(const Rect& rect, const Visit& visit) const {
    glm::dvec2 first = grid_of({rect.low_m.x, rect.high_m.y}), last = grid_of({rect.high_m.x, rect.low_m.y});
    for (double row = std::ceil(first.y); row <= last.y; ++row)
        for (double column = std::ceil(first.x); column <= last.x; ++column) visit(glm::dvec2(column, row));
}

GroundRange Ground::range(const Rect& rect) const {
    GroundRange range;
    range.is_whole = extent_.contains(rect);
    if (!range.is_whole) return range;
    if (!terrain_) return {plain_height_m_, plain_height_m_, 0, true};
    Touched touched = touched_by(rect);
    Cells cells;
    for (uint32_t row = touched.top; row <= touched.bottom; ++row)
        for (uint32_t column = touched.left; column <= touched.right; ++column) cells.take(cell(column, row));
    range.steepest = double(cells.steepest), range.is_whole = !std::isinf(cells.steepest);
    if (!range.is_whole) return range;
    auto take = [&](const glm::dvec2& grid) {
        double height = height_at(grid);
        range.low_m = std::min(range.low_m, height), range.high_m = std::max(range.high_m, height);
    };
    auto corners = corners_of(rect);
    for (const glm::dvec2& corner : corners) take(grid_of(corner));
    visit_samples_inside(rect, take);
    for (auto [a, b] : {std::pair{0, 1}, {1, 3}, {3, 2}, {2, 0}})
        visit_crossings(grid_of(corners[size_t(a)]), grid_of(corners[size_t(b)]), take);
    return range;
}

GroundRange Ground::bound(const Rect& rect) const {
    GroundRange range;
    range.is_whole = extent_.contains(rect);
    if (!extent_.meets(rect)) return range;
    if (!terrain_) return {plain_height_m_, plain_height_m_, 0, range.is_whole};
    Touched touched = touched_by(rect);
    Cells cells;
    if (touched.right - touched.left < 3 && touched.bottom - touched.top < 3) {
        for (uint32_t row = touched.top; row <= touched.bottom; ++row)
            for (uint32_t column = touched.left; column <= touched.right; ++column) cells.take(cell(column, row));
    } else {
        cells = pyramid_.bound(touched.left, touched.top, touched.right, touched.bottom);
    }
    range.steepest = double(cells.steepest), range.is_whole &= !std::isinf(cells.steepest);
    if (cells.low > cells.high) return range;
    range.low_m = terrain_->height_offset_m + terrain_->height_step_m * cells.low;
    range.high_m = terrain_->height_offset_m + terrain_->height_step_m * cells.high;
    return range;
}

namespace {

// With the heights of its corners: south-west, south-east, north-west, north-east.
Sheared between_corners(const std::array<double, 4>& corners_m, const glm::dvec2& side, Diagonal diagonal) {
    auto [sw, se, nw, ne] = corners_m;
    if (diagonal == Diagonal::rising)
        return {diagonal,
                {Plane{sw, {(ne - nw) / side.x, (nw - sw) / side.y}}, Plane{sw, {(se - sw) / side.x, (ne - se) / side.y}}}};
    glm::dvec2 south_west((se - sw) / side.x, (nw - sw) / side.y), north_east((ne - nw) / side.x, (ne - se) / side.y);
    return {diagonal, {Plane{sw, south_west}, Plane{nw + se - ne, north_east}}};
}

// How far its halves are from a height at such a place from its south-west corner, at most so far.
void take(Sheared& sheared, const glm::dvec2& from_corner, const glm::dvec2& side, double height_m) {
    glm::dvec2 share = from_corner / side;
    const Plane& plane = sheared.halves[half_of(sheared.diagonal, share.x, share.y)];
    double plane_m = plane.height_m + glm::dot(plane.slope, from_corner);
    sheared.displacement_m = std::max(sheared.displacement_m, std::abs(height_m - plane_m));
}

}  // namespace

// Both surfaces are straight between the places that are looked at, so that their distance is greatest at one of them.
void Ground::displace(const Rect& rect, std::span<Sheared> all) const {
    auto corners = corners_of(rect);
    glm::dvec2 side = rect.high_m - rect.low_m;
    glm::dvec2 per_sample(terrain_->frame.metres_per_column, -terrain_->frame.metres_per_row);
    Asked asked;
    auto take_all = [&](const glm::dvec2& grid) {
        double height_m = height_at(grid, asked);
        for (Sheared& one : all) take(one, grid * per_sample - rect.low_m, side, height_m);
    };
    visit_samples_inside(rect, take_all);
    for (auto [from, to] : {std::pair{0, 1}, {1, 3}, {3, 2}, {2, 0}})
        visit_crossings(grid_of(corners[size_t(from)]), grid_of(corners[size_t(to)]), take_all);
    for (Sheared& one : all) {
        auto [from, to] = one.diagonal == Diagonal::rising ? std::pair{0, 3} : std::pair{2, 1};
        visit_crossings(grid_of(corners[size_t(from)]), grid_of(corners[size_t(to)]),
                        [&](const glm::dvec2& grid) { take(one, grid * per_sample - rect.low_m, side, height_at(grid, asked)); });
    }
}

std::array<double, 4> Ground::corner_heights_m(const Rect& rect) const {
    auto [sw, se, nw, ne] = corners_of(rect);
    return {height_m(sw), height_m(se), height_m(nw), height_m(ne)};
}

Sheared Ground::sheared(const Rect& rect, Diagonal diagonal) const {
    Sheared made = between_corners(corner_heights_m(rect), rect.high_m - rect.low_m, diagonal);
    if (terrain_) displace(rect, {&made, 1});
    return made;
}

Sheared Ground::sheared(const Rect& rect) const {
    std::array<double, 4> corners_m = corner_heights_m(rect);
    glm::dvec2 side = rect.high_m - rect.low_m;
    std::array<Sheared, 2> both{between_corners(corners_m, side, Diagonal::rising),
                                between_corners(corners_m, side, Diagonal::falling)};
    if (terrain_) displace(rect, both);
    return both[1].displacement_m < both[0].displacement_m ? both[1] : both[0];
}

}  // namespace overlook::wang_ldi
