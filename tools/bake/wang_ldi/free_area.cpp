#include "tools/bake/wang_ldi/free_area.h"

namespace overlook::wang_ldi {

FreeArea::FreeArea(std::span<const Bounds> rects, double radius, double tolerance) : radius_(radius), tolerance_(tolerance) {
    for (const Bounds& rect : rects) {
        int columns = std::max(1, int(std::ceil((rect.high_x - rect.low_x) / radius)));
        int rows = std::max(1, int(std::ceil((rect.high_y - rect.low_y) / radius)));
        double width = (rect.high_x - rect.low_x) / columns, height = (rect.high_y - rect.low_y) / rows;
        for (int r = 0; r < rows; ++r)
            for (int c = 0; c < columns; ++c)
                push({rect.low_x + c * width, rect.low_y + r * height, rect.low_x + (c + 1) * width,
                      rect.low_y + (r + 1) * height},
                     0);
    }
}

void FreeArea::push(const Bounds& square, size_t level) {
    if (squares_.size() <= level) squares_.resize(level + 1), area_.resize(level + 1, 0);
    squares_[level].push_back(square), area_[level] += square.area();
}

Bounds FreeArea::take(Random& random, size_t& level) {
    double all = 0;
    for (double area : area_) all += area;
    double left = random.next_unit() * all;
    for (level = 0; level + 1 < squares_.size() && (squares_[level].empty() || left >= area_[level]); ++level)
        left -= area_[level];
    while (squares_[level].empty()) level = level == 0 ? squares_.size() - 1 : level - 1;
    std::vector<Bounds>& from = squares_[level];
    std::swap(from[random.next_below(uint32_t(from.size()))], from.back());
    Bounds square = from.back();
    from.pop_back();
    area_[level] = from.empty() ? 0 : area_[level] - square.area();
    while (!squares_.empty() && squares_.back().empty()) squares_.pop_back(), area_.pop_back();
    return square;
}

std::optional<FreeArea::Place> FreeArea::draw(const DiscGrid& discs, Random& random) {
    while (!squares_.empty()) {
        size_t level = 0;
        Bounds square = take(random, level);
        if (discs.is_covered(square, radius_)) continue;
        double x = square.low_x + random.next_unit() * (square.high_x - square.low_x);
        double y = square.low_y + random.next_unit() * (square.high_y - square.low_y);
        double clearance = discs.clearance(x, y);
        bool is_place = clearance >= radius_;
        if (is_place || std::max(square.high_x - square.low_x, square.high_y - square.low_y) > tolerance_) {
            double middle_x = (square.low_x + square.high_x) / 2, middle_y = (square.low_y + square.high_y) / 2;
            push({square.low_x, square.low_y, middle_x, middle_y}, level + 1);
            push({middle_x, square.low_y, square.high_x, middle_y}, level + 1);
            push({square.low_x, middle_y, middle_x, square.high_y}, level + 1);
            push({middle_x, middle_y, square.high_x, square.high_y}, level + 1);
        }
        if (is_place) return Place{x, y, clearance};
    }
    return std::nullopt;
}

}  // namespace overlook::wang_ldi
