// Keys whose depths are known by formula or by marching rays over a terrain: no OpenGL.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "formats/terrain.h"
#include "runtime/lod_sprite/key.h"
#include "runtime/lod_sprite/reuse.h"
#include "runtime/view/camera.h"

namespace overlook::lod_sprite::test {

constexpr double kSky = std::numeric_limits<double>::infinity();

// depth_m(tangent right, tangent up) of the camera's rays, at a grid of so many points over its picture.
template <class Depth>
DepthGrid grid_of(const view::Camera& camera, uint32_t columns, uint32_t rows, const Depth& depth_m) {
    DepthGrid grid{columns, rows, {}};
    double focal_px = view::focal_px(camera);
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x) {
            double right = (2 * (x + 0.5) / columns - 1) * camera.width_px / (2 * focal_px);
            double up = (1 - 2 * (y + 0.5) / rows) * camera.height_px / (2 * focal_px);
            grid.depth_m.push_back(float(depth_m(right, up)));
        }
    return grid;
}

// Height of a terrain between its samples; far below outside of it.
inline double height_at_m(const terrain::Terrain& terrain, double x_m, double y_m) {
    double column = x_m / terrain.frame.metres_per_column, row = -y_m / terrain.frame.metres_per_row;
    if (column < 0 || row < 0 || column >= terrain.shape.width - 1 || row >= terrain.shape.height - 1) return -1e9;
    uint32_t x = uint32_t(column), y = uint32_t(row);
    double s = column - x, t = row - y;
    return (1 - t) * ((1 - s) * terrain.height_m(x, y) + s * terrain.height_m(x + 1, y)) +
           t * ((1 - s) * terrain.height_m(x, y + 1) + s * terrain.height_m(x + 1, y + 1));
}

// What a camera sees of a terrain, found along each ray in steps of 1 %.
inline DepthGrid seen_depths(const terrain::Terrain& terrain, const view::Camera& camera, uint32_t columns) {
    view::Axes axes = view::axes_of(camera);
    uint32_t rows = std::max(2u, columns * camera.height_px / camera.width_px);
    double farthest_m = 3 * (terrain.shape.width * terrain.frame.metres_per_column);
    return grid_of(camera, columns, rows, [&](double right, double up) {
        glm::dvec3 ray = axes.forward + right * axes.right + up * axes.up;
        for (double depth_m = camera.near_m; depth_m < farthest_m; depth_m *= 1.01) {
            glm::dvec3 at = camera.position_m + depth_m * ray;
            if (at.z <= height_at_m(terrain, at.x, at.y)) return depth_m;
        }
        return kSky;
    });
}

}  // namespace overlook::lod_sprite::test
