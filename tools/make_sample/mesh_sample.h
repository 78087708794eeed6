// What every sample that is a mesh writes: the mesh, its materials and textures, the scene and four flights.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/result.h"
#include "formats/scene.h"
#include "tools/bake/mesh.h"
#include "tools/make_sample/mesh_grid.h"

namespace overlook::sample {

// A place that a camera flies over: shares of the extent from west to east and from north to south, metres above the ground.
struct Waypoint {
    double east, south, above_m;
};

constexpr double kMeshFlight_s = 120;  // two minutes, as in the paper
constexpr double kMeshClearance_m = 60;

// Over the waypoints in even time, looking where it goes and pitch_deg up; at least kMeshClearance_m over the mesh in every
// frame.
scene::Flight mesh_flight(const MeshGrid& grid, const std::vector<Waypoint>& waypoints, double pitch_deg);

struct MeshSample {
    std::string name;                      // of the sample and its files: "three-lakes"
    mesh::Mesh mesh;                       // surfaces with their textures' bytes
    std::array<scene::Flight, 4> flights;  // of cameras A to D
    std::string recipe;
};

struct MeshSampleReport {
    std::vector<std::string> files;  // written, in order
    uint64_t position_count = 0, face_count = 0, group_count = 0;
    uint32_t packed_count = 0;
    double dense_population = 0;  // of the paper's index array
};

// Writes NAME.obj, NAME.mtl, the textures, recipe.toml, scene.json (of NAME.ovl, to be baked beside it) and flight-a.json to
// flight-d.json into a folder, which it makes where there is none. Fails with Exit::cannot_write.
Result<MeshSampleReport> write_mesh_sample(const MeshSample& sample, const std::string& folder);

// The mesh as Wavefront OBJ: metres, z up, two decimals; normals and texture coordinates with five. v runs up in OBJ and down in
// Mesh.
std::string obj_text(const mesh::Mesh& mesh, const std::string& material_library);
std::string mtl_text(const mesh::Mesh& mesh);

}  // namespace overlook::sample
