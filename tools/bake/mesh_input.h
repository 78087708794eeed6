// Meshes in: OBJ, PLY, OFF, STL and glTF, repaired and accounted for.
#pragma once

#include <cstdint>
#include <string>

#include "formats/result.h"
#include "tools/bake/mesh.h"
#include "tools/bake/mesh_motion.h"
#include "tools/bake/mesh_report.h"

namespace overlook::mesh {

// Which of the file's axes points up. The mesh's own is always z.
enum class Up : uint8_t {
    automatic = 0,  // what the form says: glTF y; the others say nothing and stay as they are
    y = 1,          // (x, y, z) of the file becomes (x, -z, y)
    z = 2,
};

struct Options {
    double metres_per_unit = 1;  // the file's unit of length; > 0
    Up up = Up::automatic;
    uint32_t lod = 0;            // of glTF nodes with MSFT_lod: 0 the node itself, else the lod-th of those named (or the last)
    bool reads_motion = false;   // whether a glTF file's animation is read into MeshFile::motion
    bool reads_textures = true;  // whether pictures beside the file are read into Surface::texture_bytes
};

// More triangles than this are not read: what counts faces in bytes of memory must stay far below 32 bits.
constexpr uint64_t kMostTriangles = 200'000'000;
// The farthest that a mesh may reach from its middle, so that areas and volumes of it are finite in 32-bit floats.
constexpr double kMostExtent_m = 1e12;

struct MeshFile {
    Mesh mesh;
    MeshReport report;
    Motion motion;  // glTF: its first animation, as far as nodes move rigidly by it; metres, axes as the mesh's
};

// Reads a mesh and repairs it (see repair). Known by its content, and by the ending where the content does not tell:
// - OBJ with its MTL beside it: polygons of any shape, negative indices, colours by vertex ("v x y z r g b"); smoothing groups
//   are not read;
// - PLY 1.0, ascii and binary of either byte order: polygons and tristrips, normals, colours by vertex or face, texture
//   coordinates by vertex or corner;
// - OFF, with N, C and ST before it, ascii;
// - STL, ascii and binary;
// - glTF 2.0, as .glb or .gltf with its buffers beside or inside: the default scene's nodes, all modes of triangles, sparse
//   accessors, KHR_draco_mesh_compression, EXT_meshopt_compression, KHR_mesh_quantization, KHR_texture_transform (applied),
//   MSFT_lod (Options::lod), the first animation's moves of nodes (MeshFile::motion; the mesh is at rest); skins and morphs rest
//   in their first pose. `uvs` are the set that the colour texture uses.
// The file may be hostile; what it names beside itself is looked for in its own folder only.
// Fails with Exit::bad_input and one line that names the file and the place, among them:
//   "a.obj: has no faces"
//   "a.obj:17: vertex 900 does not exist, there are 8; was the file cut short?"
//   "a.ply: none of its 12 faces can be drawn: 12 not_finite"
//   "a.obj: reaches 1e+300 m from its middle, at most 1e+12 m are read; give the unit that it is in"
// with Exit::impossible beyond kMostTriangles, and with Exit::bad_command for a unit that is none.
// Cost: O(bytes of the file + F), whatever the number of components.
Result<MeshFile> open_mesh(const std::string& path, const Options& options = {});

}  // namespace overlook::mesh
