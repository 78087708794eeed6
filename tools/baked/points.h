// Samples of layered depth images as points that other programs read.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/wang_ldi.h"

namespace overlook::baked {

struct Points {
    std::vector<glm::dvec3> positions_m;          // [n] in the tile's own frame: x east and y north of its corner, z up
    std::vector<std::array<uint8_t, 3>> colours;  // [n] sRGB-encoded
    std::vector<glm::vec3> normals;               // [n] of length 1, or none
    std::vector<float> splats_m;                  // [n] how wide each is drawn
};

// The samples of images of one tile and level, at the middles of their pixels; of those at the same place the first image's. By
// pixel, south-west first, in each from the lowest up.
Points points_of(const wang_ldi::ImageSet& set, uint32_t level, std::span<const wang_ldi::Ldi> ldis);

// Binary little-endian PLY without faces: x, y, z (double), nx, ny, nz (float, where there are normals), red, green, blue
// (uchar), splat_m (float). Returns its size in bytes. Fails with Exit::cannot_write.
Result<uint64_t> write_points(const std::string& path, const Points& points);

}  // namespace overlook::baked
