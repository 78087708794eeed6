#include "tests/cli/check_cut/check.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace check_cut {
namespace {

// Beyond what rounding can explain.
constexpr double kSlack_m = 1e-6;

struct Point {
    int64_t x, y;
};
using Corners = std::array<Point, 3>;

// Twice the area of a, b, c; positive if they go from the x axis towards the y axis.
int64_t area2(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The two finest triangles of the cell whose first corner is (x, y), each from the x axis towards the y axis: "upper" one first.
Corners finest_triangle(int64_t x, int64_t y, int which) {
    Point a{x, y}, b{x + 1, y}, c{x + 1, y + 1}, d{x, y + 1};
    bool diagonal_is_ac = (x % 2 == 1 && y % 2 == 1) || (x % 2 == 0 && y % 2 == 0);  // through the corner that is odd in both
    if (diagonal_is_ac) return which == 0 ? Corners{a, b, c} : Corners{a, c, d};
    return which == 0 ? Corners{a, b, d} : Corners{b, c, d};
}

class Checker {
  public:
    Checker(const Mesh& mesh, const Raster& raster, double tolerance_m)
        : mesh_(mesh),
          raster_(raster),
          tolerance_m_(tolerance_m),
          is_covered_(raster.heights_m.size()),
          cell_cover_(raster.heights_m.size() * 2),
          steps_(raster.heights_m.size() * 4) {}

    Report run() {
        report_.triangles = mesh_.triangles.size();
        for (const auto& triangle : mesh_.triangles) check_triangle(triangle);
        count_samples();
        check_cells();
        check_edges();
        check_boundary();
        return report_;
    }

  private:
    size_t index(Point p) const { return size_t(p.y * raster_.width + p.x); }
    bool is_void(Point p) const { return std::isnan(raster_.heights_m[index(p)]); }
    bool has_void(const Corners& corners) const {
        return std::any_of(corners.begin(), corners.end(), [&](Point p) { return is_void(p); });
    }

    bool place(uint32_t vertex, Point& p) const {
        const auto& [x, y, z] = mesh_.vertices[vertex];
        if (!(x >= 0 && y >= 0 && x < double(raster_.width) && y < double(raster_.height)) || !std::isfinite(z)) return false;
        p = {int64_t(x), int64_t(y)};
        return double(p.x) == x && double(p.y) == y;
    }

    void check_triangle(const std::array<uint32_t, 3>& triangle) {
        Corners corners;
        std::array<double, 3> z{};
        for (size_t k = 0; k < 3; ++k) {
            z[k] = mesh_.vertices[triangle[k]][2];
            if (!place(triangle[k], corners[k])) {
                ++report_.misplaced_corners;
                return;
            }
        }
        int64_t whole = area2(corners[0], corners[1], corners[2]);
        if (whole <= 0) {
            ++report_.turned_triangles;
            return;
        }
        cover_samples(corners, z, double(whole));
        cover_cells(corners);
        for (size_t k = 0; k < 3; ++k) add_edge(corners[k], corners[(k + 1) % 3]);
    }

    // The heights over each row are a straight line; which samples of it are inside follows from whole numbers.
    void cover_samples(const Corners& p, const std::array<double, 3>& z, double whole) {
        auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
        auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
        for (int64_t y = low_y; y <= high_y; ++y)
            for (int64_t x = low_x; x <= high_x; ++x) {
                Point q{x, y};
                int64_t of_0 = area2(p[1], p[2], q), of_1 = area2(p[2], p[0], q), of_2 = area2(p[0], p[1], q);
                if (of_0 < 0 || of_1 < 0 || of_2 < 0) continue;
                is_covered_[index(q)] = true;
                double sample_m = raster_.heights_m[index(q)];
                if (std::isnan(sample_m)) {
                    ++report_.voids_covered;
                    continue;
                }
                double mesh_m = z[0] + (double(of_1) * (z[1] - z[0]) + double(of_2) * (z[2] - z[0])) / whole;
                double deviation_m = std::abs(mesh_m - sample_m);
                report_.greatest_deviation_m = std::max(report_.greatest_deviation_m, deviation_m);
                if (!(deviation_m <= tolerance_m_ + kSlack_m)) ++report_.samples_beyond_tolerance;
            }
    }

    // A finest triangle counts as covered where its centroid is; all coordinates times 3 to stay whole. A centroid on a border
    // belongs to the triangle below or to the right of it, so to one only.
    void cover_cells(const Corners& p) {
        auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
        auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
        for (int64_t y = low_y; y < high_y; ++y)
            for (int64_t x = low_x; x < high_x; ++x)
                for (int which = 0; which < 2; ++which) {
                    Corners finest = finest_triangle(x, y, which);
                    Point centroid{finest[0].x + finest[1].x + finest[2].x, finest[0].y + finest[1].y + finest[2].y};
                    if (owns(p, centroid)) add_cover(x, y, which);
                }
    }

    static bool owns(const Corners& p, Point tripled) {
        for (size_t k = 0; k < 3; ++k) {
            Point a = p[k], b = p[(k + 1) % 3];
            int64_t side = area2({3 * a.x, 3 * a.y}, {3 * b.x, 3 * b.y}, tripled);
            bool is_top_or_left = (a.y == b.y && b.x > a.x) || b.y < a.y;
            if (side < 0 || (side == 0 && !is_top_or_left)) return false;
        }
        return true;
    }

    void add_cover(int64_t x, int64_t y, int which) {
        uint8_t& count = cell_cover_[index({x, y}) * 2 + size_t(which)];
        if (count < 255) ++count;
    }

    void count_samples() {
        for (size_t i = 0; i < is_covered_.size(); ++i) {
            report_.samples_covered += is_covered_[i];
            report_.valid_samples_uncovered += !is_covered_[i] && !std::isnan(raster_.heights_m[i]);
        }
    }

    template <class Visit>
    void for_finest(const Visit& visit) const {
        for (int64_t y = 0; y + 1 < raster_.height; ++y)
            for (int64_t x = 0; x + 1 < raster_.width; ++x)
                for (int which = 0; which < 2; ++which) visit(x, y, which, finest_triangle(x, y, which));
    }

    void check_cells() {
        for_finest([&](int64_t x, int64_t y, int which, const Corners& corners) {
            int wanted = has_void(corners) ? 0 : 1;
            report_.wrongly_covered_cells += cell_cover_[index({x, y}) * 2 + size_t(which)] != wanted;
        });
    }

    // Undirected ends in one number, and a bit for the direction.
    void add_edge(Point a, Point b) {
        uint64_t i = index(a), j = index(b);
        edges_.push_back(std::min(i, j) << 33 | std::max(i, j) << 1 | uint64_t(i < j));
    }

    void check_edges() {
        std::sort(edges_.begin(), edges_.end());
        for (size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
            uint64_t ends = edges_[begin] >> 1;
            size_t forward = 0;
            for (end = begin; end < edges_.size() && edges_[end] >> 1 == ends; ++end) forward += edges_[end] & 1;
            if (end - begin == 2 && forward == 1) continue;
            Point a = point(ends >> 32), b = point(ends & 0xffffffff);
            if (forward == 0) std::swap(a, b);
            if (end - begin > 1)
                ++report_.overused_edges;
            else if (is_on_border(a, b) || is_on_rim(a, b))
                walk(a, b, 1);
            else
                ++report_.open_interior_edges;
        }
    }

    Point point(uint64_t i) const { return {int64_t(i) % raster_.width, int64_t(i) / raster_.width}; }

    bool is_on_border(Point a, Point b) const {
        return (a.x == b.x && (a.x == 0 || a.x == raster_.width - 1)) || (a.y == b.y && (a.y == 0 || a.y == raster_.height - 1));
    }

    // Is a, b a side of a finest triangle that has a void corner?
    bool is_on_rim(Point a, Point b) const {
        if (std::abs(a.x - b.x) > 1 || std::abs(a.y - b.y) > 1) return false;
        for (int64_t y = std::max<int64_t>(0, std::min(a.y, b.y) - 1); y <= std::min(std::min(a.y, b.y), raster_.height - 2); ++y)
            for (int64_t x = std::max<int64_t>(0, std::min(a.x, b.x) - 1); x <= std::min(std::min(a.x, b.x), raster_.width - 2);
                 ++x)
                for (int which = 0; which < 2; ++which) {
                    Corners corners = finest_triangle(x, y, which);
                    if (has_void(corners) && is_corner(corners, a) && is_corner(corners, b)) return true;
                }
        return false;
    }

    static bool is_corner(const Corners& corners, Point p) {
        return std::any_of(corners.begin(), corners.end(), [&](Point q) { return q.x == p.x && q.y == p.y; });
    }

    // Adds the steps between neighbouring samples from a to b (in a row, a column or a cell's diagonal) to the boundary.
    void walk(Point a, Point b, int8_t times) {
        int64_t dx = (b.x > a.x) - (b.x < a.x), dy = (b.y > a.y) - (b.y < a.y);
        for (Point p = a; p.x != b.x || p.y != b.y; p.x += dx, p.y += dy) add_step(p, {p.x + dx, p.y + dy}, times);
    }

    // A step is kept with its first end in the order of rows: to the east, south-west, south, south-east.
    void add_step(Point a, Point b, int8_t times) {
        if (index(a) > index(b)) std::swap(a, b), times = int8_t(-times);
        size_t way = a.y == b.y ? 0 : size_t(2 + b.x - a.x);
        steps_[index(a) * 4 + way] = int8_t(steps_[index(a) * 4 + way] + times);
    }

    // With every triangle turned the same way, how often a place is covered is how often the boundary goes around it. So a
    // boundary that is step for step that of the finest triangles wanted proves that each of them is covered exactly once, and
    // nothing else at all.
    void check_boundary() {
        for_finest([&](int64_t, int64_t, int, const Corners& corners) {
            if (has_void(corners)) return;
            for (size_t k = 0; k < 3; ++k) add_step(corners[k], corners[(k + 1) % 3], -1);
        });
        for (int8_t times : steps_) report_.wrong_boundary_steps += times != 0;
    }

    const Mesh& mesh_;
    const Raster& raster_;
    double tolerance_m_;
    Report report_;
    std::vector<bool> is_covered_;
    std::vector<uint8_t> cell_cover_;
    std::vector<uint64_t> edges_;
    std::vector<int8_t> steps_;
};

}  // namespace

Report check(const Mesh& mesh, const Raster& raster, double tolerance_m) {
    return Checker(mesh, raster, tolerance_m).run();
}

std::string to_json(const Report& r) {
    std::ostringstream out;
    out << "{\"sound\": " << (r.is_sound() ? "true" : "false") << ", \"triangles\": " << r.triangles
        << ", \"samples_covered\": " << r.samples_covered << ", \"valid_samples_uncovered\": " << r.valid_samples_uncovered
        << ", \"greatest_deviation_m\": " << r.greatest_deviation_m << ", \"misplaced_corners\": " << r.misplaced_corners
        << ", \"turned_triangles\": " << r.turned_triangles << ", \"samples_beyond_tolerance\": " << r.samples_beyond_tolerance
        << ", \"voids_covered\": " << r.voids_covered << ", \"wrongly_covered_cells\": " << r.wrongly_covered_cells
        << ", \"open_interior_edges\": " << r.open_interior_edges << ", \"overused_edges\": " << r.overused_edges
        << ", \"wrong_boundary_steps\": " << r.wrong_boundary_steps << "}";
    return out.str();
}

}  // namespace check_cut
