#include "runtime/lod_sprite/paper_quadrants.h"

#include <algorithm>

#include "formats/terrain_diamond.h"

namespace overlook::lod_sprite::paper {
namespace {

bool holds_void(const terrain::Terrain& terrain, const Quadrant& q) {
    bool at_corner = terrain.is_void(q.column0, q.row0) || terrain.is_void(q.column1, q.row0) ||
                     terrain.is_void(q.column0, q.row1) || terrain.is_void(q.column1, q.row1);
    return at_corner || (q.has_centre() && terrain.is_void(q.centre_column(), q.centre_row()));
}

}  // namespace

// Diagonals are the edges whose ends differ in column and row: the long side of a triangle with legs along the axes, both legs of
// one whose long side lies along an axis. That holds as well where the raster's edge squeezes triangles, since it moves vertices
// along the axes only.
const std::vector<Quadrant>& Quadrants::of_cut(const terrain::Terrain& terrain, const terrain::Cut& low) {
    all_.clear();
    diagonals_.clear();
    uint32_t width = terrain.shape.width;
    for (size_t i = 0; i < low.indices.size(); ++i) {
        uint32_t a = sample_of_index(terrain, low, low.indices[i]);
        uint32_t b = sample_of_index(terrain, low, low.indices[i % 3 == 2 ? i - 2 : i + 1]);
        uint32_t column_a = a % width, column_b = b % width, row_a = a / width, row_b = b / width;
        if (column_a == column_b || row_a == row_b) continue;
        bool is_new = false;
        diagonals_.at({std::min(a, b), std::max(a, b), 0}, 0, is_new);
        if (!is_new) continue;
        all_.push_back({std::min(column_a, column_b), std::min(row_a, row_b), std::max(column_a, column_b),
                        std::max(row_a, row_b), (column_a < column_b) == (row_a < row_b)});
    }
    return all_;
}

const std::vector<Quadrant>& Quadrants::of_level(const terrain::Terrain& terrain, uint32_t levels) {
    all_.clear();
    const terrain::Shape& shape = terrain.shape;
    uint32_t side_log2 = shape.root_log2 - std::min(levels, shape.root_log2);
    uint32_t last_column = shape.width - 1, last_row = shape.height - 1;
    for (uint32_t j = 0; (j << side_log2) < last_row; ++j) {
        for (uint32_t i = 0; (i << side_log2) < last_column; ++i) {
            Quadrant q{i << side_log2, j << side_log2, std::min((i + 1) << side_log2, last_column),
                       std::min((j + 1) << side_log2, last_row), terrain::is_main_diagonal(i, j)};
            if (!holds_void(terrain, q)) all_.push_back(q);
        }
    }
    return all_;
}

glm::dvec3 place_of(const terrain::Terrain& terrain, uint32_t column, uint32_t row) {
    return {column * terrain.frame.metres_per_column, -double(row) * terrain.frame.metres_per_row, terrain.height_m(column, row)};
}

}  // namespace overlook::lod_sprite::paper
