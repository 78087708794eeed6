// Between a file and a mesh: triangles as they stand in the file.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "tools/bake/mesh.h"
#include "tools/bake/mesh_input.h"
#include "tools/bake/mesh_motion.h"
#include "tools/bake/mesh_report.h"

namespace overlook::mesh {

// What a reader gives. `mesh` holds faces, surfaces and attributes as in the file (nothing is welded, checked for being finite,
// or repaired, and origin_m and positions_m are empty); indices are in range. `report` says what was read.
struct Soup {
    std::vector<glm::dvec3> positions;  // in the file's unit, the faces' indices
    Mesh mesh;
    MeshReport report;
    Motion motion;                             // in the file's unit
    std::unordered_set<std::string> textures;  // names whose bytes a surface has, or that are missing
};

struct InputFile {
    std::span<const std::byte> bytes;
    std::string path;    // for messages
    std::string folder;  // where it lies, "" or with a slash at the end
    Options options;
};

// Each reads one form; the bytes may be hostile. See open_mesh.
Result<Soup> read_obj(const InputFile& file);
Result<Soup> read_ply(const InputFile& file);
Result<Soup> read_off(const InputFile& file);
Result<Soup> read_stl(const InputFile& file);
Result<Soup> read_gltf(const InputFile& file);

// Makes a mesh of a soup: drops faces that are nowhere, sets the origin, welds positions, makes the pools of attributes unique,
// repairs. `name` is the file's, for messages.
Result<MeshFile> finish(Soup soup, const InputFile& file);

// Numbers the next triangle of the file, of a polygon of enough corners. Fails with Exit::impossible beyond kMostTriangles.
Result<void> count_triangles(Soup& soup, uint64_t more, const std::string& path);
// Notes a polygon of fewer than three corners.
Result<void> drop_polygon(Soup& soup, const std::string& path);

// Reads a file that a mesh names. Only the bare name counts, so nothing outside the mesh's folder is ever opened. Empty, with a
// note that ends with `loss`, if there is no such file.
std::vector<uint8_t> read_beside(const InputFile& file, const std::string& reference, const std::string& loss,
                                 MeshReport& report);
// The part after the last slash of either kind.
std::string bare_name(std::string_view reference);
// Gives a surface its texture ("" is none) and, if it is the first of that name and they are wanted, the bytes.
void set_texture(Soup& soup, Surface& surface, const std::string& reference, const InputFile& file);

// A colour of 0..1 as 0..255; NaN is 0.
uint8_t byte_from_unit(double value);

}  // namespace overlook::mesh
