// The texels of a tile that a ray passes over, one after the other.
//
// Based on: J. Amanatides, A. Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, 1987.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace overlook::wang_ldi {

// What of a ray lies over the tile's square, in the ray's own lengths; none if first >= second.
inline glm::dvec2 over_tile(const glm::dvec3& from, const glm::dvec3& along, double tile_m) {
    double enters = 0, leaves = INFINITY;
    for (int axis = 0; axis < 2; ++axis) {
        if (along[axis] == 0) {
            if (from[axis] < 0 || from[axis] >= tile_m) return {1, 0};
            continue;
        }
        double a = -from[axis] / along[axis], b = (tile_m - from[axis]) / along[axis];
        enters = std::max(enters, std::min(a, b)), leaves = std::min(leaves, std::max(a, b));
    }
    return {enters, leaves};
}

// visit(texel, from where, to where) of each of side x side texels between `enters` and `ends`, in order, until it returns false;
// texel = row * side + column. A straight-down ray visits one.
template <class Visit>
void walk_texels(const glm::dvec3& from, const glm::dvec3& along, double tile_m, uint32_t side, double enters, double ends,
                 const Visit& visit) {
    double texel_m = tile_m / side;
    glm::dvec2 next(INFINITY), step(INFINITY);
    glm::ivec2 at(0), turn(0);
    for (int axis = 0; axis < 2; ++axis) {
        double place = (from[axis] + enters * along[axis]) / texel_m;
        at[axis] = int(std::clamp(std::floor(place), 0.0, double(side - 1)));
        if (along[axis] == 0) continue;
        turn[axis] = along[axis] > 0 ? 1 : -1;
        step[axis] = texel_m / std::abs(along[axis]);
        next[axis] = ((at[axis] + (turn[axis] > 0 ? 1 : 0)) * texel_m - from[axis]) / along[axis];
    }
    for (double begins = enters; begins < ends;) {
        int axis = next.x < next.y ? 0 : 1;
        double to = std::min(std::max(next[axis], begins), ends);
        if (!visit(uint32_t(at.y) * side + uint32_t(at.x), begins, to) || next[axis] >= ends) return;
        at[axis] += turn[axis], begins = to, next[axis] += step[axis];
        if (at[axis] < 0 || at[axis] >= int(side)) return;
    }
}

}  // namespace overlook::wang_ldi
