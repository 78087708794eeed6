// What is drawn of a thing, before it is laid on a chain's grid: vertices with all that belongs to them, faces, and what is known
// of their distance.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "formats/discrete.h"
#include "tools/bake/caveclod/triangle_tree.h"

namespace overlook::discrete {

struct ShapeVertex {
    glm::dvec3 at_m{0};  // in the chain's own world, at rest
    uint32_t part = 0;
    glm::vec3 normal{0, 0, 1};  // of length 1
    glm::vec2 uv{0};
    std::array<uint8_t, 4> colour{255, 255, 255, 255};
};

struct Shape {
    std::vector<ShapeVertex> vertices;
    std::vector<std::array<uint32_t, 3>> faces;  // counter-clockwise seen from outside
    std::vector<uint32_t> face_surface;          // [F]

    void add(const Shape& other);
    // The triangles of one part, or of all.
    std::vector<caveclod::Triangle> triangles_of(uint32_t part) const;
    std::vector<caveclod::Triangle> triangles() const;
    double area_m2() const;
    // The faces whose mark is 0, with the vertices that they use. is_gone: [F].
    Shape without(std::span<const uint8_t> is_gone) const;
};

// Where the levels' numbers stand: 16 bits over all that is in them.
struct Grid {
    glm::dvec3 origin_m{0};
    double position_step_m = 1;
    glm::dvec2 uv_low{0};
    double uv_step = 1;
};
Grid grid_of(std::span<const Shape> shapes);

// Lays a shape on the grid: vertices made one where nothing tells them apart, triangles by surface, those near each
// other together, and in the order that suits vertex caches. rounding_m grows to how far a vertex was moved. Same shape, same level.
Level level_of(const Shape& shape, const Grid& grid, double& rounding_m);

// What is drawn of a level, on its grid; by part, or all.
std::vector<caveclod::Triangle> triangles_of(const Chain& chain, const Level& level, uint32_t part);
std::vector<caveclod::Triangle> triangles_of(const Chain& chain, const Level& level);

// The nearest float that is not less.
float rounded_up(double value);

// Sets the sphere that holds all levels at any time of the clip.
void fit_sphere(Chain& chain);

}  // namespace overlook::discrete
