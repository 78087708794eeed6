// Small terrains whose cuts are written by hand.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/terrain.h"
#include "runtime/terrain/refine.h"
#include "runtime/view/camera.h"

namespace overlook::lod_sprite::paper::test {

// side x side samples, 10 m apart, at height 0; heights in metres.
inline terrain::Terrain plain_terrain(uint32_t side) {
    terrain::Terrain terrain;
    terrain.shape = terrain::shape_of(side, side);
    terrain.frame.metres_per_column = terrain.frame.metres_per_row = 10;
    terrain.heights.assign(size_t(side) * side, 0);
    return terrain;
}

// The triangles of a grid of squares, each `step` cells wide and cut from its north-west to its south-east corner.
inline terrain::Cut squares_cut(uint32_t side, uint32_t step) {
    terrain::Cut cut;
    for (uint32_t row = 0; row + step < side; row += step)
        for (uint32_t column = 0; column + step < side; column += step) {
            uint32_t nw = row * side + column, ne = nw + step, sw = nw + step * side, se = sw + step;
            for (uint32_t corner : {ne, nw, se, sw, se, nw}) cut.indices.push_back(corner);
        }
    return cut;
}

// 90 degrees wide and high, 0.15 degrees a pixel.
inline view::Camera square_camera(const glm::dvec3& position_m, double heading_deg, double pitch_deg) {
    view::Camera camera;
    camera.position_m = position_m;
    camera.heading_deg = heading_deg, camera.pitch_deg = pitch_deg;
    camera.fov_y_deg = 90;
    camera.width_px = camera.height_px = 600;
    return camera;
}

}  // namespace overlook::lod_sprite::paper::test
