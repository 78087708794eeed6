// Chains of levels made by hand, whose errors have a closed form.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "formats/discrete.h"

namespace overlook::discrete::made {

using Colour = std::array<uint8_t, 4>;

// A box of places for vertices: origin_m its lowest corner, 65,535 steps its side.
inline Chain empty_chain(const glm::dvec3& lowest_m, double side_m) {
    Chain chain;
    chain.origin_m = lowest_m;
    chain.position_step_m = side_m / 65535;
    chain.uv_step = 1.0 / 65535;
    chain.attributes = {true, false, true};
    chain.middle_m = lowest_m + glm::dvec3(side_m / 2);
    chain.radius_m = side_m * std::sqrt(3.0) / 2;
    chain.surfaces.resize(1);
    return chain;
}

inline std::array<int16_t, 2> octahedral(const glm::dvec3& normal) {
    glm::dvec3 n = normal / (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
    glm::dvec2 at(n.x, n.y);
    if (n.z < 0) at = (1.0 - glm::abs(glm::dvec2(n.y, n.x))) * glm::dvec2(n.x < 0 ? -1 : 1, n.y < 0 ? -1 : 1);
    return {int16_t(std::lround(at.x * 32767)), int16_t(std::lround(at.y * 32767))};
}

inline uint32_t add_vertex(const Chain& chain, Level& level, const glm::dvec3& at_m, const glm::dvec3& normal, Colour colour,
                           uint16_t part = 0) {
    glm::dvec3 steps = (at_m - chain.origin_m) / chain.position_step_m;
    Vertex vertex;
    for (int i = 0; i < 3; ++i) vertex.position[size_t(i)] = uint16_t(std::lround(steps[i]));
    vertex.part = part;
    vertex.normal = octahedral(normal);
    vertex.colour = colour;
    level.vertices.push_back(vertex);
    return uint32_t(level.vertices.size() - 1);
}

// Corners counter-clockwise from outside, all of one normal.
inline void add_quad(const Chain& chain, Level& level, const std::array<glm::dvec3, 4>& corners_m, Colour colour,
                     uint16_t part = 0) {
    glm::dvec3 normal = glm::normalize(glm::cross(corners_m[1] - corners_m[0], corners_m[3] - corners_m[0]));
    std::array<uint32_t, 4> at{};
    for (size_t i = 0; i < 4; ++i) at[i] = add_vertex(chain, level, corners_m[i], normal, colour, part);
    for (size_t i : {0, 1, 2, 0, 2, 3}) level.indices.push_back(at[i]);
}

inline void end_level(Chain& chain, Level level, double error_m, double lost_area_share = 0) {
    level.draws = {{0, 0, uint32_t(level.indices.size())}};
    level.error_m = float(error_m);
    level.lost_area_share = float(lost_area_share);
    chain.levels.push_back(std::move(level));
}

// A globe of `rows` x 2 `rows` quads (and the slivers at its poles) whose vertices lie on a sphere.
inline Level globe(const Chain& chain, const glm::dvec3& middle_m, double radius_m, uint32_t rows, Colour colour) {
    Level level;
    uint32_t columns = 2 * rows;
    for (uint32_t row = 0; row <= rows; ++row) {
        for (uint32_t column = 0; column <= columns; ++column) {
            double latitude = std::numbers::pi * (double(row) / rows - 0.5), longitude = 2 * std::numbers::pi * column / columns;
            glm::dvec3 out{std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                           std::sin(latitude)};
            add_vertex(chain, level, middle_m + radius_m * out, out, colour);
        }
    }
    for (uint32_t row = 0; row < rows; ++row) {
        for (uint32_t column = 0; column < columns; ++column) {
            uint32_t a = row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
            for (uint32_t corner : {a, b, d, a, d, c}) level.indices.push_back(corner);
        }
    }
    return level;
}
// Bounds how far such a globe lies from its sphere: by the diagonal of its greatest quad.
inline double globe_error_m(double radius_m, uint32_t rows) {
    double half_diagonal = std::sqrt(2.0) * radius_m * std::sin(std::numbers::pi / rows / 2);
    return radius_m - std::sqrt(std::max(radius_m * radius_m - half_diagonal * half_diagonal, 0.0));
}

// A sphere of radius 1 round the origin, each level with half the rows of the finer one.
inline Chain sphere_chain(uint32_t finest_rows = 32, uint32_t levels = 4) {
    Chain chain = empty_chain(glm::dvec3(-1), 2);
    for (uint32_t k = 0; k < levels; ++k) {
        uint32_t rows = finest_rows >> k;
        double error_m = k == 0 ? 0 : globe_error_m(1, rows) + globe_error_m(1, finest_rows);
        end_level(chain, globe(chain, glm::dvec3(0), 1, rows, {210, 60, 50, 255}), error_m);
    }
    chain.radius_m = 1;
    return chain;
}

inline Level cube(const Chain& chain, double half_m, Colour colour) {
    Level level;
    for (int axis = 0; axis < 3; ++axis) {
        for (double side : {-1.0, 1.0}) {
            glm::dvec3 out(0), u(0), v(0);
            out[axis] = side * half_m, u[(axis + 1) % 3] = half_m, v[(axis + 2) % 3] = side * half_m;
            add_quad(chain, level, {out - u - v, out + u - v, out + u + v, out - u + v}, colour);
        }
    }
    return level;
}

// The paper's worst case: a red sphere of radius 1 and a blue cube, whose silhouettes do not match.
inline Chain simple_chain(double cube_half_m = 0.8) {
    Chain chain = empty_chain(glm::dvec3(-1), 2);
    end_level(chain, globe(chain, glm::dvec3(0), 1, 16, {210, 50, 40, 255}), 0);
    double error_m = std::max(cube_half_m * std::sqrt(3.0) - 1, 1 - cube_half_m) + globe_error_m(1, 16);
    end_level(chain, cube(chain, cube_half_m, {40, 80, 220, 255}), error_m);
    chain.radius_m = std::max(1.0, cube_half_m * std::sqrt(3.0)) + chain.position_step_m;
    return chain;
}

// Seen from the south: a red disc and a blue square, of one layer each, so that nothing has an inside.
inline Chain flat_chain() {
    Chain chain = empty_chain(glm::dvec3(-1), 2);
    Level disc;
    constexpr int kCorners = 24;
    uint32_t middle = add_vertex(chain, disc, {0, 0, 0}, {0, -1, 0}, {210, 50, 40, 255});
    for (int i = 0; i < kCorners; ++i) {
        double angle = 2 * std::numbers::pi * i / kCorners;
        add_vertex(chain, disc, {std::cos(angle), 0, std::sin(angle)}, {0, -1, 0}, {210, 50, 40, 255});
    }
    for (uint32_t i = 0; i < kCorners; ++i)
        for (uint32_t corner : {middle, middle + 1 + i, middle + 1 + (i + 1) % kCorners}) disc.indices.push_back(corner);
    end_level(chain, std::move(disc), 0);
    Level square;
    add_quad(chain, square, {glm::dvec3{-0.8, 0, -0.8}, {0.8, 0, -0.8}, {0.8, 0, 0.8}, {-0.8, 0, 0.8}}, {40, 80, 220, 255});
    end_level(chain, std::move(square), 0.8 * std::sqrt(2.0) - 1 + 0.2);
    return chain;
}

// Two cubes that are the same, of other colours: nothing but coplanar faces.
inline Chain coplanar_chain() {
    Chain chain = empty_chain(glm::dvec3(-1), 2);
    end_level(chain, cube(chain, 0.8, {220, 200, 40, 255}), 0);
    end_level(chain, cube(chain, 0.8, {40, 160, 60, 255}), 0.05);
    return chain;
}

// A post with a wheel of blades that turns about y once in 4 seconds, and the same with half the blades.
inline Chain windmill_chain() {
    Chain chain = empty_chain(glm::dvec3(-2), 4);
    for (uint32_t blades : {8u, 4u}) {
        Level level;
        add_quad(chain, level, {glm::dvec3{-0.1, 0.1, -2}, {0.1, 0.1, -2}, {0.1, 0.1, 0}, {-0.1, 0.1, 0}}, {120, 90, 60, 255});
        for (uint32_t blade = 0; blade < blades; ++blade) {
            double angle = 2 * std::numbers::pi * blade / blades;
            glm::dvec3 along(std::sin(angle), 0, std::cos(angle)), side(0.15 * std::cos(angle), 0, -0.15 * std::sin(angle));
            add_quad(chain, level, {-side, side, 1.5 * along + side, 1.5 * along - side}, {230, 230, 220, 255}, 1);
        }
        end_level(chain, std::move(level), blades == 8 ? 0 : 0.6, blades == 8 ? 0 : 0.4);
    }
    Part wheel;
    wheel.name = "wheel";
    for (int quarter = 0; quarter <= 4; ++quarter) {
        wheel.at_s.push_back(float(quarter));
        wheel.poses.push_back({glm::angleAxis(float(std::numbers::pi / 2 * quarter), glm::vec3(0, 1, 0)), glm::vec3(0)});
    }
    chain.parts.push_back(wheel);
    chain.clip_s = 4;
    return chain;
}

}  // namespace overlook::discrete::made
