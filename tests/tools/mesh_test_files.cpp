#include "tests/tools/mesh_test_files.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <glm/geometric.hpp>

#include "tools/bake/mesh_repair.h"

namespace overlook::mesh::test {

size_t faces_refused_by_openmesh(const Mesh& mesh) {
    OpenMesh::TriMesh_ArrayKernelT<> topology;
    std::vector<OpenMesh::VertexHandle> handles;
    for (const glm::vec3& p : mesh.positions_m) handles.push_back(topology.add_vertex({p.x, p.y, p.z}));
    size_t refused = 0;
    for (const Corners& face : mesh.faces)
        refused += !topology.add_face(handles[face[0]], handles[face[1]], handles[face[2]]).is_valid();
    return refused;
}

void expect_whole(const MeshFile& file) {
    const MeshReport& report = file.report;
    EXPECT_EQ(first_fault(file.mesh), "");
    EXPECT_EQ(faces_refused_by_openmesh(file.mesh), 0u);
    EXPECT_EQ(report.face_count, file.mesh.faces.size());
    EXPECT_EQ(report.position_count, file.mesh.positions_m.size());
    ASSERT_EQ(report.triangle_count, report.face_count + report.dropped.size());
    std::vector<uint8_t> is_there(size_t(report.triangle_count), 0);
    for (const uint32_t source : file.mesh.face_source) ++is_there[source];
    for (const DroppedFace& face : report.dropped) ++is_there[face.source];
    for (size_t i = 0; i < is_there.size(); ++i) ASSERT_EQ(is_there[i], 1) << "triangle " << i << " of the file";
}

MeshFile open_whole(const std::string& path, const Options& options) {
    Result<MeshFile> file = open_mesh(path, options);
    EXPECT_TRUE(file) << file.error().message;
    if (!file) return {};
    expect_whole(*file);
    return std::move(*file);
}

void expect_refused(const std::string& path, Exit exit, const std::string& words) {
    const Result<MeshFile> file = open_mesh(path);
    ASSERT_FALSE(file) << path;
    EXPECT_EQ(file.error().exit, exit) << file.error().message;
    EXPECT_NE(file.error().message.find(words), std::string::npos) << file.error().message;
    EXPECT_EQ(file.error().message.find('\n'), std::string::npos) << file.error().message;
    EXPECT_EQ(file.error().message.rfind(path, 0), 0u) << file.error().message;
}

double area_of(const Mesh& mesh) {
    double area = 0;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        const glm::dvec3 a(corner_m(mesh, f, 0)), b(corner_m(mesh, f, 1)), c(corner_m(mesh, f, 2));
        area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return area;
}

}  // namespace overlook::mesh::test
