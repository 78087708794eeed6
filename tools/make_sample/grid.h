// A square grid of numbers and its eight neighbours, shared by the landscape's passes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace overlook::sample {

// values: [side, side] row-major, north first; cells of cell_m metres, square.
struct Grid {
    uint32_t side = 0;
    double cell_m = 1;
    std::vector<double> values;

    Grid() = default;
    Grid(uint32_t side_, double cell_m_, double value = 0) : side(side_), cell_m(cell_m_), values(size_t(side_) * side_, value) {}
    double& at(uint32_t column, uint32_t row) { return values[size_t(row) * side + column]; }
    double at(uint32_t column, uint32_t row) const { return values[size_t(row) * side + column]; }
    bool is_border(size_t index) const {
        size_t column = index % side, row = index / side;
        return column == 0 || row == 0 || column + 1 == side || row + 1 == side;
    }
};

struct Neighbour {
    int dx, dy;
    double distance;  // in cells
};
constexpr double kDiagonal = 1.4142135623730951;
constexpr std::array<Neighbour, 8> kNeighbours = {{{1, 0, 1},
                                                   {1, 1, kDiagonal},
                                                   {0, 1, 1},
                                                   {-1, 1, kDiagonal},
                                                   {-1, 0, 1},
                                                   {-1, -1, kDiagonal},
                                                   {0, -1, 1},
                                                   {1, -1, kDiagonal}}};

// Calls visit(neighbour's index, distance in cells, k) for every neighbour k of a cell that lies on the grid.
template <class Visit>
void for_neighbours(uint32_t side, size_t index, const Visit& visit) {
    int64_t column = int64_t(index % side), row = int64_t(index / side);
    for (size_t k = 0; k < kNeighbours.size(); ++k) {
        int64_t x = column + kNeighbours[k].dx, y = row + kNeighbours[k].dy;
        if (x < 0 || y < 0 || x >= int64_t(side) || y >= int64_t(side)) continue;
        visit(size_t(y) * side + size_t(x), kNeighbours[k].distance, k);
    }
}

}  // namespace overlook::sample
