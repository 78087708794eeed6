#include "tools/make_sample/mesh_grid.h"

#include <algorithm>
#include <cmath>

namespace overlook::sample {
namespace {

struct Cell {
    uint32_t column, row;
};

Cell cell_of(const MeshGrid& grid, uint32_t face) {
    uint32_t cell = face / 2, cells = grid.columns - 1;
    return {cell % cells, cell / cells};
}

// Twice the area of a, b, c seen from above; positive counter-clockwise.
double area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Weights of a face's corners at (x, y), and whether none is negative.
struct Inside {
    std::array<double, 3> weights;
    double least;
};

Inside weigh(const MeshGrid& grid, uint32_t face, double x_m, double y_m) {
    std::array<uint32_t, 3> f = grid.face(face);
    glm::dvec3 p(x_m, y_m, 0), a = grid.positions_m[f[0]], b = grid.positions_m[f[1]], c = grid.positions_m[f[2]];
    double whole = area(a, b, c);
    std::array<double, 3> weights = {area(p, b, c) / whole, area(a, p, c) / whole, area(a, b, p) / whole};
    return {weights, std::min({weights[0], weights[1], weights[2]})};
}

double height_on(const MeshGrid& grid, uint32_t face, const std::array<double, 3>& weights) {
    std::array<uint32_t, 3> f = grid.face(face);
    return weights[0] * grid.positions_m[f[0]].z + weights[1] * grid.positions_m[f[1]].z + weights[2] * grid.positions_m[f[2]].z;
}

}  // namespace

std::array<uint32_t, 3> MeshGrid::face(uint32_t face) const {
    Cell cell = cell_of(*this, face);
    uint32_t north_west = index(cell.column, cell.row), south_west = north_west + columns;
    if (face % 2 == 0) return {north_west, south_west, south_west + 1};
    return {north_west, south_west + 1, north_west + 1};
}

glm::dvec3 MeshGrid::centre_m(uint32_t index_of_face) const {
    std::array<uint32_t, 3> f = face(index_of_face);
    return (positions_m[f[0]] + positions_m[f[1]] + positions_m[f[2]]) / 3.0;
}

std::array<int64_t, 3> faces_beside(const MeshGrid& grid, uint32_t face) {
    Cell cell = cell_of(grid, face);
    int64_t row_step = 2 * int64_t(grid.columns - 1), at = face;
    if (face % 2 == 0) return {cell.column > 0 ? at - 1 : -1, cell.row + 2 < grid.rows ? at + row_step + 1 : -1, at + 1};
    return {at - 1, cell.column + 2 < grid.columns ? at + 1 : -1, cell.row > 0 ? at - row_step - 1 : -1};
}

mesh::Mesh mesh_of_grid(const MeshGrid& grid, const Dress& dress) {
    mesh::Mesh made;
    for (const glm::dvec3& at : grid.positions_m) made.positions_m.emplace_back(at);
    made.face_surface = dress.surface;
    for (uint32_t face = 0; face < grid.face_count(); ++face) {
        made.faces.push_back(grid.face(face));
        made.face_source.push_back(face);
    }
    for (uint32_t position = 0; position < grid.positions_m.size(); ++position) made.uvs.push_back(dress.uv_of(position));
    made.face_uvs = made.faces;

    uint32_t shadings = 1u + *std::max_element(dress.shading.begin(), dress.shading.end());
    std::vector<glm::dvec3> sums(grid.positions_m.size() * shadings, glm::dvec3(0));
    for (uint32_t face = 0; face < grid.face_count(); ++face) {
        const std::array<uint32_t, 3>& f = made.faces[face];
        glm::dvec3 a = grid.positions_m[f[0]];
        glm::dvec3 normal = glm::cross(grid.positions_m[f[1]] - a, grid.positions_m[f[2]] - a);
        for (uint32_t corner : f) sums[corner * shadings + dress.shading[face]] += normal;
    }
    std::vector<uint32_t> index(sums.size(), mesh::kNone);
    for (size_t i = 0; i < sums.size(); ++i) {
        if (sums[i] == glm::dvec3(0)) continue;
        index[i] = uint32_t(made.normals.size());
        made.normals.emplace_back(sums[i] / std::sqrt(glm::dot(sums[i], sums[i])));
    }
    for (uint32_t face = 0; face < grid.face_count(); ++face) {
        made.face_normals.push_back({});
        for (uint32_t c = 0; c < 3; ++c)
            made.face_normals.back()[c] = index[made.faces[face][c] * shadings + dress.shading[face]];
    }
    return made;
}

double height_m(const MeshGrid& grid, double x_m, double y_m) {
    const glm::dvec3 &first = grid.positions_m.front(), &last = grid.positions_m.back();
    x_m = std::clamp(x_m, first.x, last.x);
    y_m = std::clamp(y_m, last.y, first.y);
    auto cell_at = [](double share, uint32_t cells) { return std::min(uint32_t(std::max(0.0, share * cells)), cells - 1); };
    uint32_t column = cell_at((x_m - first.x) / (last.x - first.x), grid.columns - 1);
    uint32_t row = cell_at((y_m - first.y) / (last.y - first.y), grid.rows - 1);

    // The best face of the column, and of those beside it, from the row outward.
    double best_least = -HUGE_VAL, best_m = 0;
    for (uint32_t away = 0; away < grid.rows && best_least < -1e-9; ++away)
        for (int side : {-1, 1})
            for (uint32_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, grid.columns - 2); ++c) {
                int64_t r = int64_t(row) + side * int64_t(away);
                if (r < 0 || r + 1 >= int64_t(grid.rows)) continue;
                for (uint32_t half = 0; half < 2; ++half) {
                    uint32_t face = 2 * (uint32_t(r) * (grid.columns - 1) + c) + half;
                    Inside inside = weigh(grid, face, x_m, y_m);
                    if (inside.least <= best_least) continue;
                    best_least = inside.least;
                    best_m = height_on(grid, face, inside.weights);
                }
            }
    return best_m;
}

}  // namespace overlook::sample
