#include "tools/make_sample/shapes.h"

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace overlook::sample {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

glm::dvec3 side_of(const glm::dvec3& along) {
    return glm::normalize(glm::cross(std::abs(along.z) > 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1), along));
}

uint32_t ShapeMaker::add_position(const glm::dvec3& at_m) {
    mesh_.positions_m.emplace_back(at_m);
    return uint32_t(mesh_.positions_m.size() - 1);
}

uint32_t ShapeMaker::add_normal(const glm::dvec3& normal) {
    mesh_.normals.emplace_back(glm::normalize(normal));
    return uint32_t(mesh_.normals.size() - 1);
}

void ShapeMaker::add_face(uint32_t surface, const mesh::Corners& positions, const mesh::Corners& normals,
                          const mesh::Corners& uvs) {
    mesh_.face_source.push_back(uint32_t(mesh_.faces.size()));
    mesh_.faces.push_back(positions), mesh_.face_normals.push_back(normals), mesh_.face_uvs.push_back(uvs);
    mesh_.face_surface.push_back(surface);
}

void ShapeMaker::add_fan(uint32_t surface, uint32_t first, uint32_t sides, bool is_end) {
    glm::dvec3 middle_m(0);
    for (uint32_t side = 0; side < sides; ++side) middle_m += glm::dvec3(mesh_.positions_m[first + side]) / double(sides);
    glm::dvec3 a(mesh_.positions_m[first]), b(mesh_.positions_m[first + sides / 3]);
    glm::dvec3 normal = glm::cross(a - middle_m, b - middle_m) * (is_end ? 1.0 : -1.0);
    uint32_t middle = add_position(middle_m), n = add_normal(normal);
    for (uint32_t side = 0; side < sides; ++side) {
        uint32_t here = first + side, next = first + (side + 1) % sides;
        add_face(surface, {middle, is_end ? here : next, is_end ? next : here}, {n, n, n},
                 {mesh::kNone, mesh::kNone, mesh::kNone});
    }
}

void ShapeMaker::add_tube(uint32_t surface, uint32_t rings, uint32_t sides, bool has_ends,
                          const std::function<glm::dvec3(double, double)>& at) {
    auto first = uint32_t(mesh_.positions_m.size()), first_normal = uint32_t(mesh_.normals.size());
    for (uint32_t ring = 0; ring <= rings; ++ring)
        for (uint32_t side = 0; side < sides; ++side) {
            constexpr double kStep = 1e-4;
            double along = double(ring) / rings, angle = kTurn * side / sides;
            add_position(at(along, angle));
            glm::dvec3 round = at(along, angle + kStep) - at(along, angle - kStep);
            glm::dvec3 onward = at(std::min(1.0, along + kStep), angle) - at(std::max(0.0, along - kStep), angle);
            add_normal(glm::cross(round, onward));
        }
    constexpr mesh::Corners kNoUv{mesh::kNone, mesh::kNone, mesh::kNone};
    for (uint32_t ring = 0; ring < rings; ++ring)
        for (uint32_t side = 0; side < sides; ++side) {
            uint32_t a = ring * sides + side, b = ring * sides + (side + 1) % sides, c = a + sides, d = b + sides;
            for (const auto& [i, j, k] : {mesh::Corners{a, b, d}, mesh::Corners{a, d, c}})
                add_face(surface, {first + i, first + j, first + k}, {first_normal + i, first_normal + j, first_normal + k},
                         kNoUv);
        }
    if (!has_ends) return;
    add_fan(surface, first, sides, false);
    add_fan(surface, first + rings * sides, sides, true);
}

void ShapeMaker::add_bar(uint32_t surface, uint32_t rings, uint32_t sides, const glm::dvec3& from_m, const glm::dvec3& to_m,
                         double from_radius_m, double to_radius_m) {
    glm::dvec3 along = glm::normalize(to_m - from_m), first = side_of(along), second = glm::cross(along, first);
    add_tube(surface, rings, sides, true, [&](double share, double angle) {
        return glm::mix(from_m, to_m, share) +
               glm::mix(from_radius_m, to_radius_m, share) * (std::cos(angle) * first + std::sin(angle) * second);
    });
}

void ShapeMaker::add_card(uint32_t surface, const glm::dvec3& middle_m, const glm::dvec3& right_m, const glm::dvec3& up_m,
                          const glm::vec3& normal) {
    uint32_t p = add_position(middle_m - right_m - up_m), n = add_normal(glm::dvec3(normal));
    add_position(middle_m + right_m - up_m), add_position(middle_m + right_m + up_m), add_position(middle_m - right_m + up_m);
    auto uv = uint32_t(mesh_.uvs.size());
    for (glm::vec2 at : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)}) mesh_.uvs.push_back(at);
    add_face(surface, {p, p + 1, p + 2}, {n, n, n}, {uv, uv + 1, uv + 2});
    add_face(surface, {p, p + 2, p + 3}, {n, n, n}, {uv, uv + 2, uv + 3});
}

void ShapeMaker::add_box(uint32_t surface, const glm::dvec3& middle_m, const glm::dvec3& x_m, const glm::dvec3& y_m,
                         const glm::dvec3& z_m, uint32_t columns, uint32_t rows) {
    constexpr mesh::Corners kNoUv{mesh::kNone, mesh::kNone, mesh::kNone};
    auto side = [&](const glm::dvec3& out_m, const glm::dvec3& right_m, const glm::dvec3& up_m, uint32_t across, uint32_t along) {
        auto first = uint32_t(mesh_.positions_m.size());
        uint32_t n = add_normal(out_m);
        for (uint32_t row = 0; row <= along; ++row)
            for (uint32_t column = 0; column <= across; ++column)
                add_position(middle_m + out_m + right_m * (2.0 * column / across - 1) + up_m * (2.0 * row / along - 1));
        for (uint32_t row = 0; row < along; ++row)
            for (uint32_t column = 0; column < across; ++column) {
                uint32_t a = first + row * (across + 1) + column, b = a + 1, c = a + across + 1, d = c + 1;
                add_face(surface, {a, b, d}, {n, n, n}, kNoUv);
                add_face(surface, {a, d, c}, {n, n, n}, kNoUv);
            }
    };
    side(z_m, x_m, y_m, columns, rows), side(-z_m, y_m, x_m, rows, columns);
    side(x_m, y_m, z_m, rows, 1), side(-x_m, z_m, y_m, 1, rows);
    side(y_m, z_m, x_m, 1, columns), side(-y_m, x_m, z_m, columns, 1);
}

}  // namespace overlook::sample
