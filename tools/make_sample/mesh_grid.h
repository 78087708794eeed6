// Ground as a triangle mesh over a grid of positions, which need not be evenly spaced.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "tools/bake/mesh.h"

namespace overlook::sample {

// positions_m: [rows, columns] row-major, north first; x east, y north, z up. Seen from above no cell is folded.
// Cell (column, row) has faces 2 (row (columns - 1) + column), at its south-west, and the one after, at its north-east; they meet
// on the diagonal from north-west to south-east.
struct MeshGrid {
    uint32_t columns = 0, rows = 0;
    std::vector<glm::dvec3> positions_m;

    uint32_t index(uint32_t column, uint32_t row) const { return row * columns + column; }
    const glm::dvec3& at(uint32_t column, uint32_t row) const { return positions_m[index(column, row)]; }
    uint32_t face_count() const { return 2 * (columns - 1) * (rows - 1); }
    std::array<uint32_t, 3> face(uint32_t index) const;
    glm::dvec3 centre_m(uint32_t face) const;
};

// [F] lists of the faces that share an edge with each face, -1 where there is none: three a face, across its edges from corner 0
// to 1, 1 to 2 and 2 to 0.
std::array<int64_t, 3> faces_beside(const MeshGrid& grid, uint32_t face);

// What the mesh's corners carry besides their position.
struct Dress {
    std::vector<uint32_t> surface;  // [F]
    std::vector<uint8_t> shading;   // [F] normals are smooth within one number and break between two
    std::function<glm::vec2(uint32_t position)> uv_of;
};

// The mesh, positions relative to (0, 0, 0), normals the means over the faces of one shading round a position, weighted by area.
// No surfaces yet.
mesh::Mesh mesh_of_grid(const MeshGrid& grid, const Dress& dress);

// Height of the mesh over (x, y), found from the cell that the place would have in an even grid; places outside are those of the
// border. Exact for evenly spaced grids; else looked for among the cells round about. O(1), but O(columns + rows) at worst.
double height_m(const MeshGrid& grid, double x_m, double y_m);

}  // namespace overlook::sample
