// Meshes whose surface groups are known by hand.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <glm/glm.hpp>

#include "tools/bake/mesh.h"

namespace overlook::caveclod {

using FaceCorners = std::array<uint32_t, 3>;

inline mesh::Mesh mesh_of(std::vector<glm::vec3> positions_m, std::vector<FaceCorners> faces) {
    mesh::Mesh made;
    made.positions_m = std::move(positions_m);
    made.faces = std::move(faces);
    made.face_surface.assign(made.faces.size(), 0);
    made.face_source.resize(made.faces.size());
    for (uint32_t face = 0; face < made.faces.size(); ++face) made.face_source[face] = face;
    made.surfaces.resize(1);
    return made;
}

// Texture coordinates by corner, a pool entry for each.
inline void set_uvs(mesh::Mesh& mesh, const std::function<glm::vec2(uint32_t face, uint32_t corner)>& uv_of) {
    mesh.uvs.clear();
    mesh.face_uvs.clear();
    for (uint32_t face = 0; face < mesh.faces.size(); ++face) {
        mesh.face_uvs.push_back({});
        for (uint32_t corner = 0; corner < 3; ++corner) {
            mesh.face_uvs.back()[corner] = uint32_t(mesh.uvs.size());
            mesh.uvs.push_back(uv_of(face, corner));
        }
    }
}

// One normal a face, its own.
inline void shade_flat(mesh::Mesh& mesh) {
    for (const FaceCorners& f : mesh.faces) {
        glm::dvec3 a(mesh.positions_m[f[0]]), b(mesh.positions_m[f[1]]), c(mesh.positions_m[f[2]]);
        uint32_t index = uint32_t(mesh.normals.size());
        mesh.normals.push_back(glm::vec3(glm::normalize(glm::cross(b - a, c - a))));
        mesh.face_normals.push_back({index, index, index});
    }
}

// Position i: x by bit 0, y by bit 1, z by bit 2. Two faces a side, in the order -z +z -y +y -x +x.
inline mesh::Mesh cube() {
    std::vector<glm::vec3> positions;
    for (int i = 0; i < 8; ++i) positions.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
    std::vector<FaceCorners> faces;
    for (const std::array<uint32_t, 4>& q : std::initializer_list<std::array<uint32_t, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        faces.push_back({q[0], q[1], q[2]});
        faces.push_back({q[0], q[2], q[3]});
    }
    return mesh_of(std::move(positions), std::move(faces));
}

// (columns + 1) x (rows + 1) positions a metre apart, two faces a cell: cell (x, y) has faces 2 (y columns + x) and the one
// after.
inline mesh::Mesh plane(uint32_t columns, uint32_t rows) {
    std::vector<glm::vec3> positions;
    std::vector<FaceCorners> faces;
    for (uint32_t y = 0; y <= rows; ++y)
        for (uint32_t x = 0; x <= columns; ++x) positions.emplace_back(x, y, 0);
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            uint32_t a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
            faces.push_back({a, b, d});
            faces.push_back({a, d, c});
        }
    return mesh_of(std::move(positions), std::move(faces));
}

// The side of a cylinder, position y * columns + x, its picture unwrapped from column 0 on: there u is both 0 and 1.
inline mesh::Mesh unwrapped_cylinder(uint32_t columns, uint32_t rows) {
    std::vector<glm::vec3> positions;
    std::vector<FaceCorners> faces;
    for (uint32_t y = 0; y <= rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            double angle = 6.283185307179586 * x / columns;
            positions.emplace_back(std::cos(angle), std::sin(angle), y);
        }
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            uint32_t right = (x + 1) % columns, a = y * columns + x, b = y * columns + right;
            faces.push_back({a, b, b + columns});
            faces.push_back({a, b + columns, a + columns});
        }
    mesh::Mesh made = mesh_of(std::move(positions), std::move(faces));
    set_uvs(made, [&](uint32_t face, uint32_t corner) {
        uint32_t position = made.faces[face][corner], x = position % columns, cell = face / 2 % columns;
        return glm::vec2(x == 0 && cell + 1 == columns ? float(columns) : float(x), float(position / columns));
    });
    return made;
}

// A Klein bottle of columns x rows cells, cut where its sides would meet turned over: two rows of positions that are one, linked.
inline mesh::Mesh cut_klein_bottle(uint32_t columns, uint32_t rows) {
    mesh::Mesh made = unwrapped_cylinder(columns, rows);
    made.face_uvs.clear();
    made.uvs.clear();
    made.link.resize(made.positions_m.size());
    for (uint32_t i = 0; i < made.link.size(); ++i) made.link[i] = i;
    for (uint32_t x = 0; x < columns; ++x) made.link[rows * columns + x] = (columns - x) % columns;
    return made;
}

// count tetrahedra that were cut apart: each has positions of its own, linked to those of the others at the same place.
inline mesh::Mesh cut_tetrahedra(uint32_t count) {
    mesh::Mesh made = mesh_of({}, {});
    for (uint32_t i = 0; i < count; ++i) {
        for (const glm::vec3& at : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, float(i + 1))})
            made.positions_m.push_back(at);
        uint32_t a = 4 * i;
        for (const FaceCorners& face :
             {FaceCorners{a, a + 2, a + 1}, {a, a + 1, a + 3}, {a + 1, a + 2, a + 3}, {a, a + 3, a + 2}})
            made.faces.push_back(face);
        made.link.insert(made.link.end(), {0, 1, 2, a + 3});
    }
    made.face_surface.assign(made.faces.size(), 0);
    return made;
}

// A plane or torus with random surfaces in patches, texture coordinates torn along random edges, colours, flat facets here and
// smooth ground there, holes, and pieces that touch in one point; its faces in random order.
inline mesh::Mesh random_mesh(uint32_t seed, uint32_t columns = 12, uint32_t rows = 9) {
    std::mt19937 random(seed);
    auto below = [&](uint32_t n) { return uint32_t(random() % n); };
    mesh::Mesh made = plane(columns, rows);
    for (glm::vec3& at : made.positions_m) at.z = float(below(8)) / 8;
    if (below(2) == 0)  // a ring: the last column is the first
        for (FaceCorners& face : made.faces)
            for (uint32_t& corner : face)
                if (corner % (columns + 1) == columns) corner -= columns;

    uint32_t surface_count = 1 + below(4), patch = 1 + below(5);
    made.surfaces.resize(surface_count);
    for (uint32_t face = 0; face < made.faces.size(); ++face)
        made.face_surface[face] = (face / 2 % columns / patch * 7 + face / 2 / columns / patch * 3) % surface_count;
    uint32_t calm = 8 + 120 * below(3);  // one face in so many is torn off, one corner in four times as many
    std::vector<uint32_t> shift(made.faces.size());
    for (uint32_t& s : shift) s = below(calm) == 0;
    set_uvs(made, [&](uint32_t face, uint32_t corner) {
        return glm::vec2(float(made.faces[face][corner] % 16 + (below(4 * calm) == 0 ? 1 : 0)), float(shift[face]));
    });

    shade_flat(made);
    uint32_t flat_count = uint32_t(made.normals.size()), facet_count = below(2) * below(uint32_t(made.faces.size()));
    made.normals.emplace_back(0, 0, 1);
    for (uint32_t face = facet_count; face < made.faces.size(); ++face)
        made.face_normals[face] = {flat_count, flat_count, flat_count};
    made.colours = {{255, 255, 255, 255}, {9, 9, 9, 255}};
    for (uint32_t face = 0; face < made.faces.size(); ++face) made.face_colours.push_back({0, 0, below(4 * calm) == 0 ? 1u : 0u});

    std::vector<uint32_t> order(made.faces.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[below(uint32_t(i))]);
    order.resize(order.size() - below(2) * below(uint32_t(order.size() / 3)));
    mesh::Mesh shuffled = made;
    auto pick = [&](auto& to, const auto& from) {
        to.clear();
        for (uint32_t face : order) to.push_back(from[face]);
    };
    pick(shuffled.faces, made.faces);
    pick(shuffled.face_surface, made.face_surface);
    pick(shuffled.face_source, made.face_source);
    pick(shuffled.face_uvs, made.face_uvs);
    pick(shuffled.face_normals, made.face_normals);
    pick(shuffled.face_colours, made.face_colours);
    return shuffled;
}

// The same faces in another order, each begun at another corner. order: [F] which of the old ones stands at each new place.
inline mesh::Mesh permuted(const mesh::Mesh& mesh, const std::vector<uint32_t>& order) {
    mesh::Mesh made = mesh;
    auto turn = [](FaceCorners corners, uint32_t by) {
        std::rotate(corners.begin(), corners.begin() + by, corners.end());
        return corners;
    };
    for (uint32_t face = 0; face < order.size(); ++face) {
        uint32_t from = order[face], by = from % 3;
        made.faces[face] = turn(mesh.faces[from], by);
        made.face_surface[face] = mesh.face_surface[from];
        if (!mesh.face_normals.empty()) made.face_normals[face] = turn(mesh.face_normals[from], by);
        if (!mesh.face_uvs.empty()) made.face_uvs[face] = turn(mesh.face_uvs[from], by);
        if (!mesh.face_colours.empty()) made.face_colours[face] = turn(mesh.face_colours[from], by);
    }
    return made;
}

}  // namespace overlook::caveclod
