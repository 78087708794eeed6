// A cut as a mesh that other programs read.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/terrain.h"

namespace overlook {

enum class MeshSpace {
    local,   // metres: x right, y up the raster, z height (glTF: y height, z down the raster)
    raster,  // x = column, y = row of the source raster (north first), z = height in metres
};

struct MeshReport {
    uint64_t vertex_count = 0, triangle_count = 0, file_bytes = 0;
    double rounding_m = 0;  // what storing positions as 32-bit floats may move a vertex by; 0 where doubles or exact
};

// Writes a cut of a terrain ([3n] indices, row * width + column) as binary little-endian PLY or as GLB, by the path's extension,
// atomically. Only vertices in use are written, in raster order. PLY coordinates are floats where that is exact, else doubles;
// GLB has floats about a translated node. Colours are those of the texture, if there is one and space is local. Fails with
// Exit::cannot_write, or Exit::bad_command for another extension.
Result<MeshReport> write_mesh(const std::string& path, MeshSpace space, const terrain::Terrain& terrain,
                              std::span<const uint32_t> indices);

// One triangle list with positions and colours, ready for a file.
struct MeshData {
    std::vector<double> positions;  // [3n] z is height, which glTF has as y
    std::vector<uint8_t> colours;   // [3n] or empty
    std::vector<uint32_t> indices;  // [3m], counter-clockwise seen from outside
};
Result<void> write_ply(const std::string& path, const MeshData& mesh, MeshReport& report);
// By the path's extension: write_ply or write_glb. Fails with Exit::bad_command for another.
Result<MeshReport> write_triangles(const std::string& path, const MeshData& mesh);
Result<void> write_glb(const std::string& path, const MeshData& mesh, MeshReport& report);

}  // namespace overlook
