// Meshes made in code, whose simplification has a known answer.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "tools/bake/caveclod/groups.h"
#include "tools/bake/caveclod/simplify.h"
#include "tools/bake/caveclod/surface_distance.h"
#include "tools/bake/mesh.h"

namespace overlook::caveclod::test {

inline void finish(mesh::Mesh& mesh) {
    mesh.face_surface.assign(mesh.faces.size(), 0);
    for (uint32_t f = 0; f < mesh.faces.size(); ++f) mesh.face_source.push_back(f);
    mesh.surfaces.resize(1);
}

// columns x rows squares over 0..1, each cut in two; height_m of x and y.
inline mesh::Mesh grid(uint32_t columns, uint32_t rows, const std::function<double(double, double)>& height_m) {
    mesh::Mesh mesh;
    for (uint32_t y = 0; y <= rows; ++y)
        for (uint32_t x = 0; x <= columns; ++x) {
            double at_x = double(x) / columns, at_y = double(y) / rows;
            mesh.positions_m.emplace_back(at_x, at_y, height_m(at_x, at_y));
        }
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            uint32_t a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
            bool turn = (x + y) % 2 == 0;
            mesh.faces.push_back(turn ? mesh::Corners{a, b, d} : mesh::Corners{a, b, c});
            mesh.faces.push_back(turn ? mesh::Corners{a, d, c} : mesh::Corners{b, d, c});
        }
    finish(mesh);
    return mesh;
}

// Two sheets of side x side squares with a relief, `apart_m` from each other: the lower looks up, the upper down.
inline mesh::Mesh facing_sheets(uint32_t side, double apart_m) {
    auto relief_m = [](double x, double y) { return 0.02 * std::sin(9 * x) * std::cos(7 * y); };
    mesh::Mesh mesh = grid(side, side, relief_m);
    mesh::Mesh upper = grid(side, side, [&](double x, double y) { return apart_m + relief_m(y, x); });
    uint32_t first = uint32_t(mesh.positions_m.size());
    mesh.positions_m.insert(mesh.positions_m.end(), upper.positions_m.begin(), upper.positions_m.end());
    for (const mesh::Corners& face : upper.faces) mesh.faces.push_back({first + face[0], first + face[2], first + face[1]});
    mesh.face_source.clear(), mesh.surfaces.clear();
    finish(mesh);
    return mesh;
}

// A closed strip of columns x rows squares, wrapped round in x, and in y as well if `is_torus`; else closed by fans at two poles.
inline mesh::Mesh torus(uint32_t columns, uint32_t rows, double major_m, double minor_m) {
    mesh::Mesh mesh;
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            double a = 2 * std::numbers::pi * x / columns, b = 2 * std::numbers::pi * y / rows,
                   r = major_m + minor_m * std::cos(b);
            mesh.positions_m.emplace_back(r * std::cos(a), r * std::sin(a), minor_m * std::sin(b));
        }
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            uint32_t x1 = (x + 1) % columns, y1 = (y + 1) % rows;
            uint32_t a = y * columns + x, b = y * columns + x1, c = y1 * columns + x, d = y1 * columns + x1;
            mesh.faces.push_back({a, b, d});
            mesh.faces.push_back({a, d, c});
        }
    finish(mesh);
    return mesh;
}

// Of radius 1 round the origin, columns x rows; `noise_m` pushes positions in and out.
inline mesh::Mesh sphere(uint32_t columns, uint32_t rows, double noise_m = 0) {
    mesh::Mesh mesh;
    auto add = [&](double theta, double phi) {
        double r = 1 + noise_m * std::sin(13 * phi + 2 * std::sin(7 * theta)) * std::sin(11 * theta);
        mesh.positions_m.emplace_back(r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi),
                                      r * std::cos(theta));
    };
    add(0, 0);
    for (uint32_t y = 1; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) add(std::numbers::pi * y / rows, 2 * std::numbers::pi * x / columns);
    add(std::numbers::pi, 0);
    uint32_t south = uint32_t(mesh.positions_m.size()) - 1;
    auto at = [&](uint32_t x, uint32_t y) { return 1 + (y - 1) * columns + x % columns; };
    for (uint32_t x = 0; x < columns; ++x) {
        mesh.faces.push_back({0, at(x, 1), at(x + 1, 1)});
        for (uint32_t y = 1; y + 1 < rows; ++y) {
            mesh.faces.push_back({at(x, y), at(x, y + 1), at(x + 1, y + 1)});
            mesh.faces.push_back({at(x, y), at(x + 1, y + 1), at(x + 1, y)});
        }
        mesh.faces.push_back({at(x, rows - 1), south, at(x + 1, rows - 1)});
    }
    finish(mesh);
    return mesh;
}

// An open cylinder of radius 1 and height 1, unwrapped once round: texture coordinates 0 and 1 meet along one seam.
inline mesh::Mesh seamed_cylinder(uint32_t columns, uint32_t rows) {
    mesh::Mesh mesh;
    for (uint32_t y = 0; y <= rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            double a = 2 * std::numbers::pi * x / columns;
            mesh.positions_m.emplace_back(std::cos(a), std::sin(a), double(y) / rows);
        }
        for (uint32_t x = 0; x <= columns; ++x) mesh.uvs.emplace_back(double(x) / columns, double(y) / rows);
    }
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            auto at = [&](uint32_t i, uint32_t j) { return j * columns + i % columns; };
            auto uv = [&](uint32_t i, uint32_t j) { return j * (columns + 1) + i; };
            mesh.faces.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
            mesh.face_uvs.push_back({uv(x, y), uv(x + 1, y), uv(x + 1, y + 1)});
            mesh.faces.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
            mesh.face_uvs.push_back({uv(x, y), uv(x + 1, y + 1), uv(x, y + 1)});
        }
    finish(mesh);
    return mesh;
}

// The surface of the unit cube, n x n squares a side.
inline mesh::Mesh cube(uint32_t n) {
    mesh::Mesh mesh;
    std::vector<uint32_t> ids((n + 1) * (n + 1) * (n + 1), mesh::kNone);
    auto at = [&](glm::uvec3 p) {
        uint32_t& id = ids[(p.z * (n + 1) + p.y) * (n + 1) + p.x];
        if (id == mesh::kNone) {
            id = uint32_t(mesh.positions_m.size());
            mesh.positions_m.push_back(glm::vec3(p) / float(n));
        }
        return id;
    };
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (uint32_t side : {0u, n})
            for (uint32_t i = 0; i < n; ++i)
                for (uint32_t j = 0; j < n; ++j) {
                    auto corner = [&](uint32_t u, uint32_t v) {
                        glm::uvec3 p;
                        p[axis] = side, p[(axis + 1) % 3] = u, p[(axis + 2) % 3] = v;
                        return at(p);
                    };
                    uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
                    mesh.faces.push_back(side != 0 ? mesh::Corners{a, b, c} : mesh::Corners{a, c, b});
                    mesh.faces.push_back(side != 0 ? mesh::Corners{a, c, d} : mesh::Corners{a, d, c});
                }
    finish(mesh);
    return mesh;
}

inline double rough_m(double x, double y) {
    return 0.1 * std::sin(5 * x + 3 * std::sin(4 * y)) + 0.03 * std::sin(31 * x + 17 * y) * std::cos(29 * y) +
           0.01 * std::sin(97 * x * y + 60 * x);
}

inline std::vector<Triangle> triangles_of(std::span<const glm::vec3> positions_m,
                                          std::span<const std::array<uint32_t, 3>> faces) {
    std::vector<Triangle> triangles;
    for (const auto& f : faces)
        triangles.push_back({glm::dvec3(positions_m[f[0]]), glm::dvec3(positions_m[f[1]]), glm::dvec3(positions_m[f[2]])});
    return triangles;
}

}  // namespace overlook::caveclod::test
