// A shape onto a chain's grid.
#include <algorithm>
#include <array>
#include <cmath>

#include "formats/caveclod_octahedral.h"
#include "formats/value_codecs.h"
#include "tools/bake/discrete/shape.h"

namespace overlook::discrete {
namespace {

uint16_t step_of(double value, double low, double step) {
    return uint16_t(std::clamp(std::round((value - low) / step), 0.0, 65535.0));
}

Vertex vertex_of(const ShapeVertex& from, const Grid& grid, double& rounding_m) {
    Vertex to;
    glm::dvec3 stored_m(0);
    for (int axis = 0; axis < 3; ++axis) {
        to.position[size_t(axis)] = step_of(from.at_m[axis], grid.origin_m[axis], grid.position_step_m);
        stored_m[axis] = grid.origin_m[axis] + grid.position_step_m * to.position[size_t(axis)];
    }
    rounding_m = std::max(rounding_m, glm::distance(stored_m, from.at_m));
    to.part = uint16_t(from.part);
    glm::dvec2 normal = caveclod::octahedral_of(glm::dvec3(from.normal));
    for (int i = 0; i < 2; ++i) {
        to.normal[size_t(i)] = int16_t(std::clamp(std::round(normal[i] * 32767), -32767.0, 32767.0));
        to.uv[size_t(i)] = step_of(double(from.uv[i]), grid.uv_low[i], grid.uv_step);
    }
    to.colour = from.colour;
    return to;
}

// Every third bit of 30 is one of the lowest ten.
uint32_t spread(uint32_t bits) {
    uint32_t every_third = 0;
    for (uint32_t i = 0; i < 10; ++i) every_third |= (bits >> i & 1u) << (3 * i);
    return every_third;
}

// By surface, by part, then along a Z curve through the triangles' middles (Morton 1966): what stands one after the other stands
// near each other, leaves that touch nothing as well, so that a plane divides few runs of triangles (runtime/discrete/split.h).
std::vector<uint32_t> face_order(const Shape& shape, const std::vector<Vertex>& vertices) {
    std::vector<std::array<uint32_t, 4>> keys;
    for (uint32_t f = 0; f < shape.faces.size(); ++f) {
        uint32_t along = 0;
        for (size_t axis = 0; axis < 3; ++axis) {
            uint32_t sum = 0;
            for (uint32_t corner : shape.faces[f]) sum += vertices[corner].position[axis];
            along |= spread(sum / 3 >> 6) << axis;
        }
        keys.push_back({uint32_t(shape.face_surface[f]), vertices[shape.faces[f][0]].part, along, f});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<uint32_t> order;
    for (const auto& key : keys) order.push_back(key.back());
    return order;
}

}  // namespace

Level level_of(const Shape& shape, const Grid& grid, double& rounding_m) {
    Level level;
    level.vertices.reserve(shape.vertices.size());
    for (const ShapeVertex& v : shape.vertices) level.vertices.push_back(vertex_of(v, grid, rounding_m));
    for (uint32_t f : face_order(shape, level.vertices)) {
        if (level.draws.empty() || level.draws.back().surface != shape.face_surface[f])
            level.draws.push_back({shape.face_surface[f], uint32_t(level.indices.size()), 0});
        level.draws.back().index_count += 3;
        level.indices.insert(level.indices.end(), shape.faces[f].begin(), shape.faces[f].end());
    }
    std::vector<IndexRun> runs;
    for (const Draw& draw : level.draws) runs.push_back({draw.first_index, draw.index_count});
    level.vertices.resize(meshopt_order(std::as_writable_bytes(std::span(level.vertices)), sizeof(Vertex), level.indices, runs));
    return level;
}

}  // namespace overlook::discrete
