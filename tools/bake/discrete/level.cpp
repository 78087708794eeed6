// A shape onto a chain's grid. The seam to meshoptimizer.
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/caveclod_octahedral.h"
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

// One vertex for all that are equal.
void weld(Level& level) {
    std::vector<uint32_t> remap(level.vertices.size());
    size_t count = meshopt_generateVertexRemap(remap.data(), level.indices.data(), level.indices.size(), level.vertices.data(),
                                               level.vertices.size(), sizeof(Vertex));
    std::vector<Vertex> welded(count);
    meshopt_remapVertexBuffer(welded.data(), level.vertices.data(), level.vertices.size(), sizeof(Vertex), remap.data());
    meshopt_remapIndexBuffer(level.indices.data(), level.indices.data(), level.indices.size(), remap.data());
    level.vertices = std::move(welded);
}

void order_for_caches(Level& level) {
    for (const Draw& draw : level.draws) {
        uint32_t* first = level.indices.data() + draw.first_index;
        meshopt_optimizeVertexCache(first, first, draw.index_count, level.vertices.size());
    }
    std::vector<Vertex> fetched(level.vertices.size());
    fetched.resize(meshopt_optimizeVertexFetch(fetched.data(), level.indices.data(), level.indices.size(), level.vertices.data(),
                                               level.vertices.size(), sizeof(Vertex)));
    level.vertices = std::move(fetched);
}

}  // namespace

Level level_of(const Shape& shape, const Grid& grid, double& rounding_m) {
    Level level;
    level.vertices.reserve(shape.vertices.size());
    for (const ShapeVertex& v : shape.vertices) level.vertices.push_back(vertex_of(v, grid, rounding_m));
    std::vector<uint32_t> order(shape.faces.size());
    for (uint32_t f = 0; f < order.size(); ++f) order[f] = f;
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return shape.face_surface[a] < shape.face_surface[b]; });
    for (uint32_t f : order) {
        if (level.draws.empty() || level.draws.back().surface != shape.face_surface[f])
            level.draws.push_back({shape.face_surface[f], uint32_t(level.indices.size()), 0});
        level.draws.back().index_count += 3;
        level.indices.insert(level.indices.end(), shape.faces[f].begin(), shape.faces[f].end());
    }
    weld(level);
    order_for_caches(level);
    return level;
}

}  // namespace overlook::discrete
