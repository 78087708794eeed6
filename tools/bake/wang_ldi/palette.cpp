#include "tools/bake/wang_ldi/palette.h"

#include <algorithm>
#include <cmath>

namespace overlook::wang_ldi {
namespace {

using Vec = std::array<double, 3>;

// Colours of a small cell together: 4 codes a side.
struct Cell {
    Vec sum{};
    double count = 0;
    uint32_t colour = 0;

    double at(size_t axis) const { return sum[axis] / count; }
};

size_t cell_of(const Colour& colour) {
    return size_t(colour[0] >> 2) << 12 | size_t(colour[1] >> 2) << 6 | size_t(colour[2] >> 2);
}

struct Box {
    size_t begin = 0, end = 0;  // of the cells
    size_t axis = 0;
    double badness = 0;  // sum of squares about the mean, along that axis
};

Box box_of(const std::vector<Cell>& cells, size_t begin, size_t end) {
    Box box{begin, end, 0, 0};
    for (size_t axis = 0; axis < 3; ++axis) {
        double count = 0, sum = 0, squares = 0;
        for (size_t c = begin; c < end; ++c) {
            double value = cells[c].at(axis);
            count += cells[c].count, sum += cells[c].count * value, squares += cells[c].count * value * value;
        }
        double spread = squares - sum * sum / count;
        if (spread > box.badness) box.badness = spread, box.axis = axis;
    }
    return end - begin > 1 ? box : Box{begin, end, 0, 0};
}

// Cuts the worst box where its colours are halved, until there are enough.
std::vector<Box> cut(std::vector<Cell>& cells, uint32_t most) {
    std::vector<Box> boxes{box_of(cells, 0, cells.size())};
    while (boxes.size() < most) {
        auto worst =
            std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.badness < b.badness; });
        if (worst->badness <= 0) break;
        Box box = *worst;
        std::sort(cells.begin() + long(box.begin), cells.begin() + long(box.end), [&](const Cell& a, const Cell& b) {
            return std::pair(a.at(box.axis), a.sum) < std::pair(b.at(box.axis), b.sum);
        });
        double half = 0, left = 0;
        for (size_t c = box.begin; c < box.end; ++c) half += cells[c].count / 2;
        size_t middle = box.begin;
        while (middle + 2 < box.end && left + cells[middle].count < half) left += cells[middle++].count;
        *worst = box_of(cells, box.begin, middle + 1);
        boxes.push_back(box_of(cells, middle + 1, box.end));
    }
    return boxes;
}

Vec mean_of(const std::vector<Cell>& cells, const Box& box) {
    Vec sum{};
    double count = 0;
    for (size_t c = box.begin; c < box.end; ++c) {
        for (size_t axis = 0; axis < 3; ++axis) sum[axis] += cells[c].sum[axis];
        count += cells[c].count;
    }
    return {sum[0] / count, sum[1] / count, sum[2] / count};
}

void choose_nearest(std::vector<Cell>& cells, const std::vector<Vec>& means) {
    for (Cell& cell : cells) {
        double best = INFINITY;
        for (size_t m = 0; m < means.size(); ++m) {
            double distance = 0;
            for (size_t axis = 0; axis < 3; ++axis) {
                double off = cell.at(axis) - means[m][axis];
                distance += off * off;
            }
            if (distance < best) best = distance, cell.colour = uint32_t(m);
        }
    }
}

void move_to_middles(const std::vector<Cell>& cells, std::vector<Vec>& means) {
    std::vector<Vec> sums(means.size());
    std::vector<double> counts(means.size());
    for (const Cell& cell : cells) {
        for (size_t axis = 0; axis < 3; ++axis) sums[cell.colour][axis] += cell.sum[axis];
        counts[cell.colour] += cell.count;
    }
    for (size_t m = 0; m < means.size(); ++m)
        if (counts[m] > 0) means[m] = {sums[m][0] / counts[m], sums[m][1] / counts[m], sums[m][2] / counts[m]};
}

double luma(const Vec& colour) {
    return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
}

}  // namespace

Palette palette_of(std::span<const Colour> all, uint32_t most) {
    Palette made;
    if (all.empty()) return made;
    std::vector<uint32_t> number(size_t(1) << 18, 0xffffffff);
    std::vector<Cell> cells;
    for (const Colour& colour : all) {
        uint32_t& n = number[cell_of(colour)];
        if (n == 0xffffffff) n = uint32_t(cells.size()), cells.emplace_back();
        for (size_t axis = 0; axis < 3; ++axis) cells[n].sum[axis] += colour[axis];
        ++cells[n].count;
    }
    std::vector<Cell> by_box = cells;
    std::vector<Vec> means;
    for (const Box& box : cut(by_box, most)) means.push_back(mean_of(by_box, box));
    for (int round = 0; round < 3; ++round) choose_nearest(cells, means), move_to_middles(cells, means);
    std::sort(means.begin(), means.end(),
              [](const Vec& a, const Vec& b) { return std::pair(luma(a), a) < std::pair(luma(b), b); });
    choose_nearest(cells, means);

    for (const Vec& mean : means)
        made.colours.push_back({uint8_t(mean[0] + 0.5), uint8_t(mean[1] + 0.5), uint8_t(mean[2] + 0.5)});
    made.indices.reserve(all.size());
    for (const Colour& colour : all) made.indices.push_back(uint8_t(cells[number[cell_of(colour)]].colour));
    return made;
}

}  // namespace overlook::wang_ldi
