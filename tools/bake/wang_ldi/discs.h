// Discs on the ground, found by place: a grid of squares, each with the discs whose middles lie in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace overlook::wang_ldi {

struct Disc {
    double x = 0, y = 0, radius = 0;
};
struct Bounds {
    double low_x = 0, low_y = 0, high_x = 0, high_y = 0;
    double area() const { return (high_x - low_x) * (high_y - low_y); }
};

class DiscGrid {
  public:
    // bounds: where middles lie, anything beyond is put to its border; most_radius: of discs and of what is asked about.
    DiscGrid(const Bounds& bounds, double most_radius)
        : bounds_(bounds),
          side_(2 * most_radius),
          columns_(count(bounds.high_x - bounds.low_x)),
          rows_(count(bounds.high_y - bounds.low_y)),
          squares_(size_t(columns_) * size_t(rows_)) {}

    void add(const Disc& disc) { squares_[size_t(row(disc.y)) * size_t(columns_) + size_t(column(disc.x))].push_back(disc); }

    // Calls visit for every disc whose middle may lie within 2 * most_radius of (x, y), until it returns false.
    template <typename Visit>
    void visit_near(double x, double y, Visit visit) const {
        int at_x = column(x), at_y = row(y);
        for (int r = std::max(0, at_y - 1); r <= std::min(rows_ - 1, at_y + 1); ++r)
            for (int c = std::max(0, at_x - 1); c <= std::min(columns_ - 1, at_x + 1); ++c)
                for (const Disc& disc : squares_[size_t(r) * size_t(columns_) + size_t(c)])
                    if (!visit(disc)) return;
    }
    // The greatest radius of a disc about (x, y) that touches none, but no more than most_radius; below 0 within one.
    double clearance(double x, double y) const {
        double least = side_ / 2;
        visit_near(x, y, [&](const Disc& disc) {
            least = std::min(least, std::hypot(disc.x - x, disc.y - y) - disc.radius);
            return true;
        });
        return least;
    }
    // Whether one disc alone leaves no place in `rect` (of a side up to most_radius) for a middle of `radius`.
    bool is_covered(const Bounds& rect, double radius) const {
        double x = (rect.low_x + rect.high_x) / 2, y = (rect.low_y + rect.high_y) / 2;
        double half_x = rect.high_x - x, half_y = rect.high_y - y;
        bool is_covered = false;
        visit_near(x, y, [&](const Disc& disc) {
            double far_x = std::abs(disc.x - x) + half_x, far_y = std::abs(disc.y - y) + half_y, reach = radius + disc.radius;
            is_covered = far_x * far_x + far_y * far_y < reach * reach;
            return !is_covered;
        });
        return is_covered;
    }

  private:
    int count(double length) const { return int(std::clamp(std::ceil(length / side_), 1.0, 4096.0)); }
    int column(double x) const { return int(std::clamp(std::floor((x - bounds_.low_x) / side_), 0.0, double(columns_ - 1))); }
    int row(double y) const { return int(std::clamp(std::floor((y - bounds_.low_y) / side_), 0.0, double(rows_ - 1))); }

    Bounds bounds_;
    double side_;
    int columns_, rows_;
    std::vector<std::vector<Disc>> squares_;
};

}  // namespace overlook::wang_ldi
